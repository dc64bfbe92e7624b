#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"

namespace rex {

/// A measured motion: pose `to` as seen from pose `from`. The information (inverse covariance) is that of
/// the error R_ij^T (R_i^T (t_j - t_i) - t_ij), followed by the rotation error.
struct PlanarEdge {
  int from = 0, to = 0;
  Eigen::Vector3d motion{0, 0, 0};  ///< x, y, heading
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};
/// The position of a landmark as seen from a pose, in its frame. The information is that of the error R_i^T
/// (l - t_i) - position.
struct LandmarkEdge {
  int pose = 0, landmark = 0;
  Eigen::Vector2d position{0, 0};
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();
};
/// Poses of a planar robot and the motions measured between them (slide 7:45), with landmarks and their
/// sightings.
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

/// The objective to minimise, summed over the edges, without a factor 1/2.
enum class PoseGraphObjective {
  kChi2,   ///< e^T information e, as in g2o
  kSESync  ///< kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2: Rosen et al., SE-Sync, 2019. kappa
           ///< and tau come from the information (planar: I_33 and 2 / tr(I_t^-1); spatial: 3 / (2
           ///< tr(I_q^-1)) and 3 / tr(I_t^-1)). A landmark is a pose without rotation
};

/// The cost of an edge with squared error s. Robust kernels grow more slowly than s, so that wrong loop
/// closures do not bend the map. k is the error (in standard deviations) from which on they differ.
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
  /// Start from the chordal relaxation of the rotations (Carlone et al. 2015) and the positions that fit
  /// them, if that costs less than the given poses. On typical maps this avoids local minima.
  bool chordalStart = true;
  int maxIterations = 1000;
  double tolerance = 1e-12;  ///< converged if a step lowers the cost by a smaller fraction, or by rounding
};

enum class PoseGraphStatus { kConverged, kBudgetSpent, kNoProgress };

struct PoseGraphResult {
  PoseGraphStatus status = PoseGraphStatus::kBudgetSpent;
  double initialCost = 0;  ///< at the given poses
  double cost = 0;
  int iterations = 0;
  std::string message{};
};

/// The cost at the poses of the graph. Throws Error naming the edge if it leads to itself or to a missing
/// pose or landmark, or if its numbers are not finite or its information is not symmetric and positive
/// semidefinite. Also throws Error for options out of range.
[[nodiscard]] double poseGraphCost(const PlanarPoseGraph& graph, const PoseGraphOptions& options = {});
[[nodiscard]] double poseGraphCost(const SpatialPoseGraph& graph, const PoseGraphOptions& options = {});

/// Moves the poses and landmarks to minimise the cost; pose 0 stays fixed. Levenberg-Marquardt steps on the
/// sparse normal equations (Lu and Milios 1997; Kuemmerle et al., g2o, 2011). Throws like poseGraphCost,
/// and Error naming a pose that is not connected to pose 0, or a landmark that no pose sees.
PoseGraphResult optimize(PlanarPoseGraph& graph, const PoseGraphOptions& options = {});
PoseGraphResult optimize(SpatialPoseGraph& graph, const PoseGraphOptions& options = {});

/// An upper bound on how much lower the kSESync cost of other poses can be; nearly zero proves that these
/// are globally optimal. It comes from the dual problem (Rosen et al. 2019, theorem 7) and is valid for any
/// poses; infinite if that gives no bound. Throws like optimize.
[[nodiscard]] double certifiedGap(const PlanarPoseGraph& graph);
[[nodiscard]] double certifiedGap(const SpatialPoseGraph& graph);

/// Sets the poses from motions alone: breadth first from pose 0, each by the first edge that reaches it in
/// the order of the edges. Then sets each landmark from its first sighting. Throws like optimize.
void setOdometryPoses(PlanarPoseGraph& graph);
void setOdometryPoses(SpatialPoseGraph& graph);

}  // namespace rex
