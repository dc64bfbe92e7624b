#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/pose_graph.h"
#include "estimation/scan_matching.h"

namespace rex {

struct LoopOptions {
  ScanMatchOptions matching{};
  double radius = 4;          ///< poses that may be nearer than this are candidates, metres
  int leastGap = 10;          ///< poses that follow each other within this many steps are none
  int candidates = 3;         ///< tried for each pose, nearest first
  double leastOverlap = 0.7;  ///< of the points of two scans
  double bound = 16.3;  ///< of squared Mahalanobis distances in three dimensions: 0.1 % of all are above
};

/// Why a candidate became an edge, or not.
enum class LoopVerdict {
  kAccepted,
  kNoMatch,  ///< matching its scans failed, or left a direction unseen
  kLittleOverlap,
  kUnlikely,     ///< it contradicts the motions in between by more than their covariance explains
  kInconsistent  ///< it fits the motions in between, but contradicts other loops, which are more
};

struct LoopCandidate {
  int from = 0, to = 0;
  LoopVerdict verdict = LoopVerdict::kNoMatch;
  ScanMatch match{};       ///< pose `to` as seen from pose `from`
  double mahalanobis = 0;  ///< squared, from where the motions in between say; 0 before it was computed
  std::string reason{};
};

/// A graph with what closing loops found.
struct LoopClosing {
  PlanarPoseGraph graph{};  ///< odometry, matches of neighbours, loops; ready for optimize()
  std::vector<LoopCandidate> candidates{};
  int accepted = 0;  ///< loops: the last edges of the graph
};

/// Edges from scans (2 x k points in the frame of each pose) for a graph of odometry, whose edges lead from
/// each pose to the next (slide 7:45). Neighbours are aligned first. Then a pose is compared with earlier
/// ones that the covariance of the motions in between lets come near it; what their scans say must overlap,
/// be likely by that covariance, and agree with other loops around cycles: of all loops the largest set is
/// kept of which every pair agrees, found greedily (Mangelson et al. 2018). Rooms that look alike are told
/// apart only as far as the motions in between do: odometry worse than the way from one to the other lets
/// them pass. Throws Error for edges that are not such a chain, counts that differ, more than 2000 poses,
/// information that is not positive definite, scans as alignScans, and options out of range.
[[nodiscard]] LoopClosing closeLoops(const PlanarPoseGraph& odometry,
                                     const std::vector<Eigen::Matrix2Xd>& scans,
                                     const LoopOptions& options = {});

/// The largest set found of which all pairs agree: numbers of rows, rising. Greedy from each row, those that
/// agree with most others first. Throws Error unless `agree` is square and symmetric.
[[nodiscard]] std::vector<int> agreeingSet(const Eigen::Matrix<bool, -1, -1>& agree);

}  // namespace rex
