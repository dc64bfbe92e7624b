#pragma once

#include <cmath>
#include <numbers>

#include "base/rng.h"
#include "estimation/pose_graph.h"
#include "geometry/rotation.h"

namespace rex::test {

/// Pose b as seen from pose a; both x, y, heading.
inline Eigen::Vector3d planarMotion(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double c = std::cos(a[2]), s = std::sin(a[2]);
  const double x = b[0] - a[0], y = b[1] - a[1];
  return {c * x + s * y, -s * x + c * y, wrapAngle(b[2] - a[2])};
}

/// A walk over a grid of streets: odometry, and closures where the robot comes by again. Poses from odometry.
inline PlanarPoseGraph streets(int poses, double noise, Rng& rng, Eigen::Matrix3Xd* truth = nullptr) {
  Eigen::Matrix3Xd X(3, poses);
  X.col(0).setZero();
  for (int i = 1; i < poses; ++i) {
    const double turn = i % 5 != 0 ? 0 : (rng.index(3) - 1) * std::numbers::pi / 2;
    const double heading = X(2, i - 1) + turn;
    X.col(i) << X(0, i - 1) + std::cos(heading), X(1, i - 1) + std::sin(heading), wrapAngle(heading);
  }
  PlanarPoseGraph graph{Eigen::Matrix3Xd::Zero(3, poses), {}};
  const auto measure = [&](int i, int j) {
    const Eigen::Vector3d deviations(noise, noise, noise / 2);
    graph.edges.push_back({i, j,
                           planarMotion(X.col(i), X.col(j)) + deviations.cwiseProduct(rng.normalVector(3)),
                           deviations.cwiseAbs2().cwiseInverse().asDiagonal()});
  };
  for (int i = 1; i < poses; ++i) measure(i - 1, i);
  for (int j = 0; j < poses; ++j)
    for (int i = 0; i + 10 < j; ++i)
      if ((X.col(i) - X.col(j)).head<2>().norm() < .5) (rng.uniform() < .5) ? measure(i, j) : measure(j, i);
  if (truth) *truth = X;
  setOdometryPoses(graph);
  return graph;
}

}  // namespace rex::test
