#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "estimation/block_cholesky_internal.h"
#include "estimation/ekf_slam.h"
#include "estimation/gaussian.h"
#include "estimation/pose_graph.h"

namespace rex::internal {

/// Throws Error for a transition without a mean, and noise that is not a covariance of three numbers.
void requireTransition(const PoseTransition& transition, Definiteness noise);

/// What one edge adds to the normal equations: its error e, the derivatives by the steps of both poses, and
/// the information that weighs it. The error is a difference of numbers of size `scale`, which rounding does
/// not let vanish.
template <int Size>
struct EdgeTerm {
  Eigen::Matrix<double, Size, 1> e, scale;
  Eigen::Matrix<double, Size, Size> Ji, Jj, information;
};

/// The unknowns are nodes: the poses, of which the first is known, and after these the landmarks. Terms are
/// the edges, then the sightings. A planar pose steps by (x, y, heading) of the world, a landmark by (x, y)
/// and a third number that nothing depends on.
struct PlanarGraphTraits {
  using Graph = PlanarPoseGraph;
  struct Unknowns {
    Eigen::Matrix3Xd poses;
    Eigen::Matrix2Xd landmarks;
  };
  static constexpr int kSize = 3;
  static int poses(const Graph& graph) { return static_cast<int>(graph.poses.cols()); }
  static int nodes(const Graph& graph) { return poses(graph) + static_cast<int>(graph.landmarks.cols()); }
  static std::size_t terms(const Graph& graph) { return graph.edges.size() + graph.sightings.size(); }
  /// The two nodes of a term.
  static std::pair<int, int> ends(const Graph& graph, std::size_t k);
  static EdgeTerm<kSize> termAt(const Graph& graph, std::size_t k, PoseGraphObjective objective);
  static EdgeTerm<kSize> term(const Graph& graph, const PlanarEdge& edge, PoseGraphObjective objective);
  static EdgeTerm<kSize> term(const Graph& graph, const LandmarkEdge& edge, PoseGraphObjective objective);
  static void step(Graph& graph, const Eigen::VectorXd& delta);
  static Unknowns unknowns(const Graph& graph) { return {graph.poses, graph.landmarks}; }
  static void set(Graph& graph, Unknowns unknowns);
};

/// A spatial pose steps by (x, y, z) of the world, then a rotation vector in its own frame.
struct SpatialGraphTraits {
  using Graph = SpatialPoseGraph;
  using Unknowns = std::vector<Pose>;
  static constexpr int kSize = 6;
  static int poses(const Graph& graph) { return static_cast<int>(graph.poses.size()); }
  static int nodes(const Graph& graph) { return poses(graph); }
  static std::size_t terms(const Graph& graph) { return graph.edges.size(); }
  static std::pair<int, int> ends(const Graph& graph, std::size_t k) {
    return {graph.edges[k].from, graph.edges[k].to};
  }
  static EdgeTerm<kSize> termAt(const Graph& graph, std::size_t k, PoseGraphObjective objective) {
    return term(graph, graph.edges[k], objective);
  }
  static EdgeTerm<kSize> term(const Graph& graph, const SpatialEdge& edge, PoseGraphObjective objective);
  static void step(Graph& graph, const Eigen::VectorXd& delta);
  static Unknowns unknowns(const Graph& graph) { return graph.poses; }
  static void set(Graph& graph, Unknowns unknowns) { graph.poses = std::move(unknowns); }
};

/// tau and kappa of SE-Sync's objective.
struct IsotropicWeights {
  double translation = 0, rotation = 0;
};
[[nodiscard]] IsotropicWeights isotropic(const PlanarEdge& edge);
[[nodiscard]] IsotropicWeights isotropic(const SpatialEdge& edge);
[[nodiscard]] IsotropicWeights isotropic(const LandmarkEdge& edge);

[[nodiscard]] Eigen::Matrix2d planarRotation(double angle);

/// The first landmark that no pose sees, if there is one.
[[nodiscard]] std::optional<int> unseenLandmark(const PlanarPoseGraph& graph);

/// The first pose that no edges join to pose 0, if there is one.
[[nodiscard]] std::optional<int> loosePose(const PlanarPoseGraph& graph);
[[nodiscard]] std::optional<int> loosePose(const SpatialPoseGraph& graph);

/// Throws Error naming the edge that is not sound, the pose that no edges join to pose 0, or the landmark
/// that no pose sees.
void requireSound(const PlanarPoseGraph& graph);
void requireSound(const SpatialPoseGraph& graph);
void requireConnected(const PlanarPoseGraph& graph);
void requireConnected(const SpatialPoseGraph& graph);

/// The pattern of all nodes but the first `known` ones: node i of the graph is node i - known of the pattern.
template <class Traits>
[[nodiscard]] std::shared_ptr<const BlockPattern> patternOf(const typename Traits::Graph& graph, int known) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(Traits::terms(graph));
  for (std::size_t k = 0; k < Traits::terms(graph); ++k) {
    const auto [a, b] = Traits::ends(graph, k);
    if (std::min(a, b) >= known) edges.emplace_back(a - known, b - known);
  }
  return std::make_shared<const BlockPattern>(Traits::nodes(graph) - known, edges);
}

/// Sets the poses and landmarks to the chordal start; pose 0 stays, and so do all where rounding leaves no
/// such start. `pattern` is patternOf(graph, 1).
void setChordalPoses(PlanarPoseGraph& graph, const std::shared_ptr<const BlockPattern>& pattern);
void setChordalPoses(SpatialPoseGraph& graph, const std::shared_ptr<const BlockPattern>& pattern);

}  // namespace rex::internal
