#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex::internal {
namespace {

// 1 / tr(I^-1); zero if some direction was not measured at all.
template <int kSize>
double inverseTrace(const Eigen::Matrix<double, kSize, kSize>& information) {
  const Eigen::FullPivLU<Eigen::Matrix<double, kSize, kSize>> factor(information);
  return factor.isInvertible() ? 1 / factor.inverse().trace() : 0;
}

}  // namespace

Eigen::Matrix2d planarRotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

IsotropicWeights isotropic(const PlanarEdge& edge) {
  return {2 * inverseTrace<2>(edge.information.topLeftCorner<2, 2>()), edge.information(2, 2)};
}

IsotropicWeights isotropic(const LandmarkEdge& edge) { return {2 * inverseTrace<2>(edge.information), 0}; }

IsotropicWeights isotropic(const SpatialEdge& edge) {
  return {3 * inverseTrace<3>(edge.information.topLeftCorner<3, 3>()),
          1.5 * inverseTrace<3>(edge.information.bottomRightCorner<3, 3>())};
}

std::pair<int, int> PlanarGraphTraits::ends(const Graph& graph, std::size_t k) {
  if (k < graph.edges.size()) return {graph.edges[k].from, graph.edges[k].to};
  const LandmarkEdge& sighting = graph.sightings[k - graph.edges.size()];
  return {sighting.pose, poses(graph) + sighting.landmark};
}

EdgeTerm<3> PlanarGraphTraits::termAt(const Graph& graph, std::size_t k, PoseGraphObjective objective) {
  if (k < graph.edges.size()) return term(graph, graph.edges[k], objective);
  return term(graph, graph.sightings[k - graph.edges.size()], objective);
}

EdgeTerm<3> PlanarGraphTraits::term(const Graph& graph, const PlanarEdge& edge,
                                    PoseGraphObjective objective) {
  const auto xi = graph.poses.col(edge.from), xj = graph.poses.col(edge.to);
  const Eigen::Vector2d d = xj.head<2>() - xi.head<2>();
  // From world to the frame of the measured pose: R_ij^T R_i^T.
  const double c = std::cos(xi[2] + edge.motion[2]), s = std::sin(xi[2] + edge.motion[2]);
  const double cij = std::cos(edge.motion[2]), sij = std::sin(edge.motion[2]);
  Eigen::Matrix2d R_ij_T, R_T, dR_T;
  R_ij_T << cij, sij, -sij, cij;
  R_T << c, s, -s, c;
  dR_T << -s, c, -c, -s;
  const double angle = wrapAngle(xj[2] - xi[2] - edge.motion[2]);
  EdgeTerm<3> term;
  term.e << R_T * d - R_ij_T * edge.motion.head<2>(), angle;
  const double reach = (xi.cwiseAbs() + xj.cwiseAbs() + edge.motion.cwiseAbs()).head<2>().sum();
  term.scale << reach, reach, std::abs(xi[2]) + std::abs(xj[2]) + std::abs(edge.motion[2]);
  term.Ji.setZero();
  term.Jj.setZero();
  term.Ji.topLeftCorner<2, 2>() = -R_T;
  term.Jj.topLeftCorner<2, 2>() = R_T;
  term.Ji.topRightCorner<2, 1>() = dR_T * d;
  term.Ji(2, 2) = -1;
  term.Jj(2, 2) = 1;
  term.information = edge.information;
  if (objective == PoseGraphObjective::kSESync) {
    // |R1 - R2|^2 = 8 sin^2(angle / 2).
    const IsotropicWeights weights = isotropic(edge);
    term.e[2] = 2 * std::sin(angle / 2);
    const double slope = std::cos(angle / 2);
    term.Ji(2, 2) = -slope;
    term.Jj(2, 2) = slope;
    term.information =
        Eigen::Vector3d(weights.translation, weights.translation, 2 * weights.rotation).asDiagonal();
  }
  return term;
}

EdgeTerm<3> PlanarGraphTraits::term(const Graph& graph, const LandmarkEdge& edge,
                                    PoseGraphObjective objective) {
  const auto x = graph.poses.col(edge.pose);
  const auto l = graph.landmarks.col(edge.landmark);
  const double c = std::cos(x[2]), s = std::sin(x[2]);
  Eigen::Matrix2d R_T, dR_T;
  R_T << c, s, -s, c;
  dR_T << -s, c, -c, -s;
  const Eigen::Vector2d d = l - x.head<2>();
  const double reach = l.cwiseAbs().sum() + x.head<2>().cwiseAbs().sum() + edge.position.cwiseAbs().sum();
  EdgeTerm<3> term;
  term.e << R_T * d - edge.position, 0;
  term.scale << reach, reach, 0;
  term.Ji.setZero();
  term.Jj.setIdentity();  // its third number keeps the equations definite
  term.Ji.topLeftCorner<2, 2>() = -R_T;
  term.Ji.topRightCorner<2, 1>() = dR_T * d;
  term.Jj.topLeftCorner<2, 2>() = R_T;
  Eigen::Matrix2d information = edge.information;
  if (objective == PoseGraphObjective::kSESync)
    information = isotropic(edge).translation * Eigen::Matrix2d::Identity();
  const double trace = information.trace();
  term.information.setZero();
  term.information.topLeftCorner<2, 2>() = information;
  term.information(2, 2) = trace > 0 ? trace / 2 : 1;
  return term;
}

void PlanarGraphTraits::set(Graph& graph, Unknowns unknowns) {
  graph.poses = std::move(unknowns.poses);
  graph.landmarks = std::move(unknowns.landmarks);
}

void PlanarGraphTraits::step(Graph& graph, const Eigen::VectorXd& delta) {
  for (Eigen::Index i = 1; i < graph.poses.cols(); ++i) {
    graph.poses.col(i) += delta.segment<3>(3 * (i - 1));
    graph.poses(2, i) = wrapAngle(graph.poses(2, i));
  }
  for (Eigen::Index i = 0; i < graph.landmarks.cols(); ++i)
    graph.landmarks.col(i) += delta.segment<2>(3 * (graph.poses.cols() + i - 1));
}

EdgeTerm<6> SpatialGraphTraits::term(const Graph& graph, const SpatialEdge& edge,
                                     PoseGraphObjective objective) {
  const Pose &X_i = graph.poses[static_cast<std::size_t>(edge.from)],
             &X_j = graph.poses[static_cast<std::size_t>(edge.to)];
  const Eigen::Matrix3d R_T = edge.motion.R.transpose() * X_i.R.transpose();
  const Eigen::Vector3d d_i = X_i.R.transpose() * (X_j.p - X_i.p);
  const Eigen::Vector4d q = quaternionFromRotation(R_T * X_j.R);  // w >= 0
  const Eigen::Matrix3d cross = skew(q.tail<3>()), even = q[0] * Eigen::Matrix3d::Identity();
  EdgeTerm<6> term;
  term.e << edge.motion.R.transpose() * (d_i - edge.motion.p), q.tail<3>();
  const double reach = (X_i.p.cwiseAbs() + X_j.p.cwiseAbs() + edge.motion.p.cwiseAbs()).sum();
  term.scale << Eigen::Vector3d::Constant(reach), Eigen::Vector3d::Ones();
  term.Ji.setZero();
  term.Jj.setZero();
  term.Ji.topLeftCorner<3, 3>() = -R_T;
  term.Jj.topLeftCorner<3, 3>() = R_T;
  term.Ji.topRightCorner<3, 3>() = edge.motion.R.transpose() * skew(d_i);
  term.Ji.bottomRightCorner<3, 3>() = -0.5 * (even - cross) * edge.motion.R.transpose();
  term.Jj.bottomRightCorner<3, 3>() = 0.5 * (even + cross);
  term.information = edge.information;
  if (objective == PoseGraphObjective::kSESync) {
    // |R1 - R2|^2 = 8 |vector part|^2.
    const IsotropicWeights weights = isotropic(edge);
    term.information.setZero();
    term.information.diagonal().head<3>().setConstant(weights.translation);
    term.information.diagonal().tail<3>().setConstant(8 * weights.rotation);
  }
  return term;
}

void SpatialGraphTraits::step(Graph& graph, const Eigen::VectorXd& delta) {
  for (std::size_t i = 1; i < graph.poses.size(); ++i) {
    const auto part = delta.segment<6>(6 * (static_cast<Eigen::Index>(i) - 1));
    graph.poses[i].p += part.head<3>();
    graph.poses[i].R = graph.poses[i].R * expSO3(part.tail<3>());
    // Rounding would add up over many steps.
    graph.poses[i].R = rotationFromQuaternion(quaternionFromRotation(graph.poses[i].R));
  }
}

}  // namespace rex::internal

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
