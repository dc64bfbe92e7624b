#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/pose_graph.h"
#include "estimation/scan_matching.h"

namespace rex {

struct LoopOptions {
  ScanMatchOptions matching{};
  double radius = 4;          ///< poses that may be closer than this are candidates, metres
  int leastGap = 10;          ///< minimum number of steps between the poses of a candidate
  int candidates = 3;         ///< candidates tried for each pose, nearest first
  double leastOverlap = 0.7;  ///< minimum overlap of the points of two scans
  double bound = 16.3;        ///< on squared Mahalanobis distances in three dimensions: 0.1 % exceed it
};

/// Why a candidate became an edge, or not.
enum class LoopVerdict {
  kAccepted,
  kNoMatch,  ///< matching its scans failed, or left a direction unobservable
  kLittleOverlap,
  kUnlikely,     ///< it contradicts the motions in between by more than their covariance explains
  kInconsistent  ///< it fits the motions in between, but contradicts a larger set of loops
};

struct LoopCandidate {
  int from = 0, to = 0;
  LoopVerdict verdict = LoopVerdict::kNoMatch;
  ScanMatch match{};       ///< pose `to` as seen from pose `from`
  double mahalanobis = 0;  ///< squared, from the pose that the motions in between predict; or 0
  std::string reason{};
};

/// The graph with the loops found.
struct LoopClosing {
  PlanarPoseGraph graph{};  ///< odometry, matches of neighbours, loops; ready for optimize()
  std::vector<LoopCandidate> candidates{};
  int accepted = 0;  ///< loops: the last edges of the graph
};

/// Finds edges by matching scans (2 x k points in the frame of each pose) for an odometry chain, whose
/// edges lead from each pose to the next (slide 7:45). Neighbours are aligned first. Then each pose is
/// compared with earlier ones that may be near it, given the covariance of the motions in between. A loop
/// must have enough overlap, be likely under that covariance, and agree with other loops: the largest
/// pairwise consistent set found greedily is kept (Mangelson et al. 2018). Rooms that look alike are
/// confused if the odometry error exceeds their distance. Throws Error for edges that are not such a chain,
/// counts that differ, more than 2000 poses, information that is not positive definite, scans like
/// alignScans, and options out of range.
[[nodiscard]] LoopClosing closeLoops(const PlanarPoseGraph& odometry,
                                     const std::vector<Eigen::Matrix2Xd>& scans,
                                     const LoopOptions& options = {});

/// The largest set found in which all pairs agree, as ascending row numbers. A greedy search from each row
/// tries those that agree with most others first. Throws Error unless `agree` is square and symmetric.
[[nodiscard]] std::vector<int> agreeingSet(const Eigen::Matrix<bool, -1, -1>& agree);

}  // namespace rex
