#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"

namespace rex {

/// A measured motion: pose `to` as seen from pose `from`. The information (inverse covariance) belongs to the
/// error R_ij^T (R_i^T (t_j - t_i) - t_ij) followed by that of the rotation.
struct PlanarEdge {
  int from = 0, to = 0;
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();  ///< x, y, heading
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};
/// Where a landmark was seen from a pose, in its frame. The information belongs to the error
/// R_i^T (l - t_i) - position.
struct LandmarkEdge {
  int pose = 0, landmark = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();
};
/// Poses of a planar robot, and what it measured between them (slide 7:45); landmarks, and where it saw them.
struct PlanarPoseGraph {
  Eigen::Matrix3Xd poses{};  ///< x, y, heading; one pose per column
  std::vector<PlanarEdge> edges{};
  Eigen::Matrix2Xd landmarks{};  ///< x, y; one landmark per column
  std::vector<LandmarkEdge> sightings{};
};

using Matrix6d = Eigen::Matrix<double, 6, 6>;
struct SpatialEdge {
  int from = 0, to = 0;
  Pose motion{};
  Matrix6d information = Matrix6d::Identity();  ///< of translation and the vector part of the unit quaternion
};
struct SpatialPoseGraph {
  std::vector<Pose> poses{};
  std::vector<SpatialEdge> edges{};
};

/// What to make small, summed over the edges; without a factor 1/2.
enum class PoseGraphObjective {
  kChi2,   ///< e^T information e, as g2o counts it
  kSESync  ///< kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2: Rosen et al., SE-Sync, 2019. kappa
           ///< and tau come from the information (planar: I_33 and 2 / tr(I_t^-1); spatial: 3 / (2
           ///< tr(I_q^-1)) and 3 / tr(I_t^-1)). A landmark is a pose without rotation
};

/// How much a squared error s of an edge counts: s, or less the larger it is, so that wrong loop closures do
/// not bend the map. k is the error (in deviations) from which on it matters.
enum class RobustKernel {
  kNone,
  kHuber,        ///< 2 k sqrt(s) - k^2 beyond k^2
  kCauchy,       ///< k^2 log(1 + s / k^2)
  kGemanMcClure  ///< s / (1 + s / k^2): also known as dynamic covariance scaling
};

struct PoseGraphOptions {
  PoseGraphObjective objective = PoseGraphObjective::kChi2;
  RobustKernel kernel = RobustKernel::kNone;
  double kernelSize = 1;  ///< k
  /// Start from the rotations that fit best when they need not be rotations (Carlone et al. 2015), then the
  /// positions that fit those, where that costs less than the poses given: no local minimum traps it on usual
  /// maps.
  bool chordalStart = true;
  int maxIterations = 1000;
  double tolerance = 1e-12;  ///< done when a step lowers the cost by less, relative to it, or by rounding
};

enum class PoseGraphStatus { kConverged, kBudgetSpent, kNoProgress };

struct PoseGraphResult {
  PoseGraphStatus status = PoseGraphStatus::kBudgetSpent;
  double initialCost = 0;  ///< at the poses given
  double cost = 0;
  int iterations = 0;
  std::string message{};
};

/// The cost at the poses of the graph. Throws Error for an edge that leads to a pose or landmark that is not
/// there, or to itself, numbers that are not finite, and information that is not symmetric and positive
/// semidefinite, naming the edge; and for options out of range.
[[nodiscard]] double poseGraphCost(const PlanarPoseGraph& graph, const PoseGraphOptions& options = {});
[[nodiscard]] double poseGraphCost(const SpatialPoseGraph& graph, const PoseGraphOptions& options = {});

/// Moves the poses and landmarks to where the cost is least; pose 0 stays. Levenberg and Marquardt's steps on
/// the sparse normal equations (Lu and Milios 1997; Kuemmerle et al., g2o, 2011). Throws as poseGraphCost,
/// and Error naming a pose that no motions join to pose 0, or a landmark that no pose sees.
PoseGraphResult optimize(PlanarPoseGraph& graph, const PoseGraphOptions& options = {});
PoseGraphResult optimize(SpatialPoseGraph& graph, const PoseGraphOptions& options = {});

/// By how much other poses could at most have a lower cost of kSESync than these: nearly zero proves that
/// these are the best of all, not only around here. From the dual problem (Rosen et al. 2019, theorem 7),
/// whatever the poses are; infinite where that says nothing. Throws as optimize.
[[nodiscard]] double certifiedGap(const PlanarPoseGraph& graph);
[[nodiscard]] double certifiedGap(const SpatialPoseGraph& graph);

/// Poses from motions alone: each by the edge that reaches it first, breadth first from pose 0, in the order
/// of the edges; then landmarks, each where it was seen first. Throws as optimize.
void setOdometryPoses(PlanarPoseGraph& graph);
void setOdometryPoses(SpatialPoseGraph& graph);

}  // namespace rex
