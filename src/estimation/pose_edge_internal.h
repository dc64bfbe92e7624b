#pragma once

#include <optional>

#include "estimation/pose_graph.h"

namespace rex::internal {

/// What one edge adds to the normal equations: its error e, the derivatives by the steps of both poses, and
/// the information that weighs it. The error is a difference of numbers of size `scale`, which rounding does
/// not let vanish.
template <int Size>
struct EdgeTerm {
  Eigen::Matrix<double, Size, 1> e, scale;
  Eigen::Matrix<double, Size, Size> Ji, Jj, information;
};

/// A planar pose steps by (x, y, heading) of the world.
struct PlanarGraphTraits {
  using Graph = PlanarPoseGraph;
  static constexpr int kSize = 3;
  static int poses(const Graph& graph) { return static_cast<int>(graph.poses.cols()); }
  static EdgeTerm<kSize> term(const Graph& graph, const PlanarEdge& edge, PoseGraphObjective objective);
  static void step(Graph& graph, const Eigen::VectorXd& delta);
};

/// A spatial pose steps by (x, y, z) of the world, then a rotation vector in its own frame.
struct SpatialGraphTraits {
  using Graph = SpatialPoseGraph;
  static constexpr int kSize = 6;
  static int poses(const Graph& graph) { return static_cast<int>(graph.poses.size()); }
  static EdgeTerm<kSize> term(const Graph& graph, const SpatialEdge& edge, PoseGraphObjective objective);
  static void step(Graph& graph, const Eigen::VectorXd& delta);
};

/// tau and kappa of SE-Sync's objective.
struct IsotropicWeights {
  double translation = 0, rotation = 0;
};
[[nodiscard]] IsotropicWeights isotropic(const PlanarEdge& edge);
[[nodiscard]] IsotropicWeights isotropic(const SpatialEdge& edge);

[[nodiscard]] Eigen::Matrix2d planarRotation(double angle);

/// The first pose that no edges join to pose 0, if there is one.
[[nodiscard]] std::optional<int> loosePose(const PlanarPoseGraph& graph);
[[nodiscard]] std::optional<int> loosePose(const SpatialPoseGraph& graph);

/// Throws Error naming the edge that is not sound, or the pose that no edges join to pose 0.
void requireSound(const PlanarPoseGraph& graph);
void requireSound(const SpatialPoseGraph& graph);
void requireConnected(const PlanarPoseGraph& graph);
void requireConnected(const SpatialPoseGraph& graph);

/// Sets the poses to the chordal start; pose 0 stays, and so do all where rounding leaves no such start.
void setChordalPoses(PlanarPoseGraph& graph);
void setChordalPoses(SpatialPoseGraph& graph);

}  // namespace rex::internal
