#include <cmath>
#include <utility>

#include <Eigen/LU>

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
