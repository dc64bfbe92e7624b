#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "estimation/covariance.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

int posesOf(const PlanarPoseGraph& graph) { return internal::PlanarGraphTraits::poses(graph); }
int posesOf(const SpatialPoseGraph& graph) { return internal::SpatialGraphTraits::poses(graph); }

template <class Edge>
std::string nameOf(std::size_t k, const Edge& edge) {
  return fmt::format("edge {} from pose {} to pose {}", k, edge.from, edge.to);
}

// Accepts what requireCovariance would accept at once, without allocating memory.
template <class Information>
bool isClearlyDefinite(const Information& information) {
  return information.allFinite() && information == information.transpose() &&
         Eigen::LLT<Information>(information).info() == Eigen::Success;
}

bool isSound(const Eigen::Vector3d& motion) { return motion.allFinite(); }
bool isSound(const Pose& motion) {
  return motion.p.allFinite() && motion.R.allFinite() && isRotation(motion.R);
}

template <class Graph>
void requireEdges(const Graph& graph) {
  for (std::size_t k = 0; k < graph.edges.size(); ++k) {
    const auto& edge = graph.edges[k];
    for (const int pose : {edge.from, edge.to}) {
      if (pose >= 0 && pose < posesOf(graph)) continue;
      throw Error({.what = nameOf(k, edge),
                   .found = fmt::format("pose {}", pose),
                   .wanted = fmt::format("0 to {}", posesOf(graph) - 1)});
    }
    if (edge.from == edge.to)
      throw Error({.what = nameOf(k, edge), .found = "one pose", .wanted = "two different ones"});
    if (!isSound(edge.motion))
      throw Error({.what = nameOf(k, edge) + ": motion", .found = "numbers that are not a pose"});
    if (!isClearlyDefinite(edge.information))
      requireCovariance(nameOf(k, edge) + ": information", edge.information, edge.information.rows());
  }
}

void requireSightings(const PlanarPoseGraph& graph) {
  const auto landmarks = static_cast<int>(graph.landmarks.cols());
  const auto requirePlace = [](const std::string& name, const char* what, int place, int count) {
    if (place >= 0 && place < count) return;
    throw Error({.what = name,
                 .found = fmt::format("{} {}", what, place),
                 .wanted = count > 0 ? fmt::format("0 to {}", count - 1) : "none: the graph has none"});
  };
  for (std::size_t k = 0; k < graph.sightings.size(); ++k) {
    const LandmarkEdge& edge = graph.sightings[k];
    const std::string name =
        fmt::format("sighting {} of landmark {} from pose {}", k, edge.landmark, edge.pose);
    requirePlace(name, "pose", edge.pose, posesOf(graph));
    requirePlace(name, "landmark", edge.landmark, landmarks);
    if (!edge.position.allFinite())
      throw Error({.what = name + ": position", .found = "numbers that are not finite"});
    if (!isClearlyDefinite(edge.information))
      requireCovariance(name + ": information", edge.information, edge.information.rows());
  }
  for (int i = 0; i < landmarks; ++i)
    if (!graph.landmarks.col(i).allFinite())
      throw Error({.what = fmt::format("landmark {}", i), .found = "numbers that are not finite"});
}

// Edges of each pose: the edge, and the pose at its other end.
template <class Graph>
std::vector<std::vector<std::pair<std::size_t, int>>> edgesByPose(const Graph& graph) {
  std::vector<std::vector<std::pair<std::size_t, int>>> result(static_cast<std::size_t>(posesOf(graph)));
  for (std::size_t k = 0; k < graph.edges.size(); ++k) {
    const auto& edge = graph.edges[k];
    result[static_cast<std::size_t>(edge.from)].emplace_back(k, edge.to);
    result[static_cast<std::size_t>(edge.to)].emplace_back(k, edge.from);
  }
  return result;
}

// Calls reach(edge, known pose, new pose) breadth first from pose 0; returns which poses were reached.
template <class Graph, class Reach>
std::vector<bool> spread(const Graph& graph, const Reach& reach) {
  const auto edges = edgesByPose(graph);
  std::vector<bool> isReached(edges.size(), false);
  std::queue<int> waiting;
  if (!edges.empty()) waiting.push(0);
  if (!edges.empty()) isReached[0] = true;
  for (; !waiting.empty(); waiting.pop()) {
    const int known = waiting.front();
    for (const auto& [edge, other] : edges[static_cast<std::size_t>(known)]) {
      if (isReached[static_cast<std::size_t>(other)]) continue;
      isReached[static_cast<std::size_t>(other)] = true;
      reach(graph.edges[edge], known, other);
      waiting.push(other);
    }
  }
  return isReached;
}

template <class Graph>
std::optional<int> firstLoose(const Graph& graph) {
  const std::vector<bool> isReached = spread(graph, [](const auto&, int, int) {});
  const auto loose = std::find(isReached.begin(), isReached.end(), false);
  if (loose == isReached.end()) return {};
  return static_cast<int>(loose - isReached.begin());
}

template <class Graph>
void requireAllReached(const Graph& graph) {
  if (const auto loose = firstLoose(graph))
    throw Error({.what = fmt::format("pose graph: pose {}", *loose),
                 .found = "no edges that join it to pose 0",
                 .wanted = "a connected graph"});
}

Pose spatial(const Eigen::Vector3d& planar) {
  return translation(planar[0], planar[1], 0) * rotation(planar[2], Eigen::Vector3d::UnitZ());
}
Eigen::Vector3d planar(const Pose& pose) {
  return {pose.p[0], pose.p[1], std::atan2(pose.R(1, 0), pose.R(0, 0))};
}

}  // namespace

namespace internal {

void requireSound(const PlanarPoseGraph& graph) {
  for (Eigen::Index i = 0; i < graph.poses.cols(); ++i)
    if (!graph.poses.col(i).allFinite())
      throw Error({.what = fmt::format("pose {}", i), .found = "numbers that are not finite"});
  requireEdges(graph);
  requireSightings(graph);
}

void requireSound(const SpatialPoseGraph& graph) {
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!isSound(graph.poses[i]))
      throw Error({.what = fmt::format("pose {}", i), .found = "numbers that are not a pose"});
  requireEdges(graph);
}

std::optional<int> loosePose(const PlanarPoseGraph& graph) { return firstLoose(graph); }
std::optional<int> loosePose(const SpatialPoseGraph& graph) { return firstLoose(graph); }

std::optional<int> unseenLandmark(const PlanarPoseGraph& graph) {
  std::vector<bool> isSeen(static_cast<std::size_t>(graph.landmarks.cols()), false);
  for (const LandmarkEdge& edge : graph.sightings) isSeen[static_cast<std::size_t>(edge.landmark)] = true;
  const auto unseen = std::find(isSeen.begin(), isSeen.end(), false);
  if (unseen == isSeen.end()) return {};
  return static_cast<int>(unseen - isSeen.begin());
}

void requireConnected(const PlanarPoseGraph& graph) {
  requireAllReached(graph);
  if (const auto unseen = unseenLandmark(graph))
    throw Error({.what = fmt::format("pose graph: landmark {}", *unseen),
                 .found = "no pose that sees it",
                 .wanted = "one or more"});
}
void requireConnected(const SpatialPoseGraph& graph) { requireAllReached(graph); }

}  // namespace internal

void setOdometryPoses(PlanarPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  spread(graph, [&](const PlanarEdge& edge, int known, int other) {
    const Pose motion = spatial(edge.motion), X = spatial(graph.poses.col(known));
    graph.poses.col(other) = planar(X * (known == edge.from ? motion : motion.inverse()));
  });
  for (auto edge = graph.sightings.rbegin(); edge != graph.sightings.rend(); ++edge)  // so the first counts
    graph.landmarks.col(edge->landmark) =
        graph.poses.col(edge->pose).head<2>() +
        internal::planarRotation(graph.poses(2, edge->pose)) * edge->position;
}

void setOdometryPoses(SpatialPoseGraph& graph) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  spread(graph, [&](const SpatialEdge& edge, int known, int other) {
    Pose& X = graph.poses[static_cast<std::size_t>(other)];
    X = graph.poses[static_cast<std::size_t>(known)] *
        (known == edge.from ? edge.motion : edge.motion.inverse());
    // Rounding, and rotations that were measured as such only nearly, would add up along the way.
    X.R = rotationFromQuaternion(quaternionFromRotation(X.R));
  });
}

}  // namespace rex
