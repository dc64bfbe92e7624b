#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "estimation/pose_graph.h"
#include "exercise.h"
#include "grading/check.h"

// Random graphs for the checks, and what is known about them.

using Poses = std::vector<Eigen::Vector3d>;

inline double byTurns(double angle) { return std::atan2(std::sin(angle), std::cos(angle)); }

inline Eigen::Matrix3d frameOf(const Eigen::Vector3d& pose) {
  Eigen::Matrix3d X;
  X << std::cos(pose[2]), -std::sin(pose[2]), pose[0], std::sin(pose[2]), std::cos(pose[2]), pose[1], 0, 0, 1;
  return X;
}

inline Eigen::Vector3d poseOf(const Eigen::Matrix3d& X) {
  return {X(0, 2), X(1, 2), std::atan2(X(1, 0), X(0, 0))};
}

/// By homogeneous matrices: b in the frame of a.
inline Eigen::Vector3d relative(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return poseOf(rex::inverse(frameOf(a)) * frameOf(b));
}

/// The pose that, seen from a, is b.
inline Eigen::Vector3d onward(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return poseOf(frameOf(a) * frameOf(b));
}

inline Eigen::Vector3d trueError(const Eigen::Vector3d& i, const Eigen::Vector3d& j,
                                 const Eigen::Vector3d& z) {
  return relative(z, relative(i, j));
}

inline Eigen::Vector3d randomPose(rex::Rng& rng, double reach, double turns = 1) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach),
          rng.uniform(-turns * std::numbers::pi, turns * std::numbers::pi)};
}

/// Symmetric positive definite, with three different axes.
inline Eigen::Matrix3d randomInformation(rex::Rng& rng) {
  Eigen::Matrix3d A;
  for (int c = 0; c < 3; ++c) A.col(c) = rng.normalVector(3) * rng.uniform(1, 8);
  return A * A.transpose() + Eigen::Matrix3d::Identity();
}

/// Random poses, and edges between them in both directions that fit badly.
inline PoseMap randomMap(rex::Rng& rng, int poses) {
  PoseMap map;
  for (int k = 0; k < poses; ++k) map.poses.push_back(randomPose(rng, 4, 3));
  const auto add = [&](int i, int j) {
    const Eigen::Vector3d z =
        relative(map.poses[static_cast<std::size_t>(i)], map.poses[static_cast<std::size_t>(j)]);
    map.edges.push_back({i, j, z + rng.uniformVector(3, -0.4, 0.4), randomInformation(rng)});
  };
  for (int k = 1; k < poses; ++k) rng.index(2) == 0 ? add(k - 1, k) : add(k, k - 1);
  for (int k = 0; k < poses / 2; ++k) {
    const int i = rng.index(poses), j = (i + 1 + rng.index(poses - 1)) % poses;
    add(i, j);
  }
  return map;
}

/// A walk over streets that cross at some angle, five poses per block; loops are closed where the robot
/// comes by again. All motions are measured with noise, and poses are those of odometry.
struct StreetWalk {
  PoseMap map;
  Poses truth;
};

inline Poses odometryOf(const PoseMap& map) {
  Poses poses{map.poses.front()};
  for (const MeasuredEdge& edge : map.edges)
    if (!edge.isLoop) poses.push_back(onward(poses.back(), edge.motion));
  return poses;
}

inline Poses anyWayAlongStreets(rex::Rng& rng, int poses, const Eigen::Vector3d& start) {
  const double corner = std::numbers::pi / 2 + rng.uniform(-0.4, 0.4);
  const double lengths[] = {rng.uniform(0.8, 1.2), rng.uniform(0.8, 1.2)};
  Poses way{start};
  for (int k = 1, street = 0; k < poses; ++k) {
    // Four crossings per block: it turns left more often than not, and so comes by again.
    double turn = 0;
    if (k % 5 == 0 && rng.uniform() >= 0.3) turn = street++ % 2 == 0 ? corner : std::numbers::pi - corner;
    way.push_back(onward(onward(way.back(), {0, 0, turn}), {lengths[street % 2], 0, 0}));
  }
  return way;
}

/// `noise` is the standard deviation of a measured step along itself [m]; twice that is the one across it,
/// and half of it that of the heading [rad].
inline StreetWalk anyStreetWalk(rex::Rng& rng, int poses, double noise, const Eigen::Vector3d& start) {
  StreetWalk walk{{}, anyWayAlongStreets(rng, poses, start)};
  walk.map.poses = walk.truth;
  const Eigen::Vector3d deviations(noise, 2 * noise, noise / 2);
  const auto add = [&](int i, int j, bool isLoop) {
    const Eigen::Vector3d z =
        relative(walk.truth[static_cast<std::size_t>(i)], walk.truth[static_cast<std::size_t>(j)]);
    // The error is seen from where the measurement says the pose is.
    const Eigen::Vector3d e = deviations.cwiseProduct(rng.normalVector(3));
    walk.map.edges.push_back(
        {i, j, onward(z, e), deviations.cwiseAbs2().cwiseInverse().asDiagonal(), isLoop});
  };
  for (int k = 1; k < poses; ++k) add(k - 1, k, false);
  for (int j = 0; j < poses; ++j)
    for (int i = 0; i + 8 < j; ++i) {
      const Eigen::Vector3d apart =
          walk.truth[static_cast<std::size_t>(i)] - walk.truth[static_cast<std::size_t>(j)];
      if (std::hypot(apart[0], apart[1]) < 0.5) rng.index(2) == 0 ? add(i, j, true) : add(j, i, true);
    }
  walk.map.poses = odometryOf(walk.map);
  return walk;
}

/// A street walk with at least ten loops.
inline StreetWalk streetWalk(rex::Rng& rng, int poses, double noise,
                             const Eigen::Vector3d& start = {0, 0, 0}) {
  for (;;) {
    const StreetWalk walk = anyStreetWalk(rng, poses, noise, start);
    if (static_cast<int>(walk.map.edges.size()) >= poses + 9) return walk;
  }
}

inline rex::PlanarPoseGraph graphOf(const PoseMap& map) {
  rex::PlanarPoseGraph graph{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(map.poses.size())), {}};
  for (std::size_t k = 0; k < map.poses.size(); ++k)
    graph.poses.col(static_cast<Eigen::Index>(k)) = map.poses[k];
  for (const MeasuredEdge& edge : map.edges)
    graph.edges.push_back({edge.from, edge.to, edge.motion, edge.information});
  return graph;
}

inline double trueCost(const PoseMap& map) { return rex::poseGraphCost(graphOf(map)); }

inline Poses bestPoses(const PoseMap& map) {
  rex::PlanarPoseGraph graph = graphOf(map);
  rex::optimize(graph);
  Poses poses;
  for (Eigen::Index k = 0; k < graph.poses.cols(); ++k) poses.emplace_back(graph.poses.col(k));
  return poses;
}

/// Root mean square distance of positions.
inline double apart(const Poses& a, const Poses& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += std::pow(std::hypot(a[k][0] - b[k][0], a[k][1] - b[k][1]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

inline void checkPoses(rex::grading::Check& check, const std::string& function, const Poses& got,
                       const Poses& start) {
  check.near("number of poses of " + function, static_cast<double>(got.size()),
             static_cast<double>(start.size()), 0);
  for (const Eigen::Vector3d& pose : got) check.shape("a pose of " + function, pose, 3, 1);
  const auto moves = check.ask("Pose 0 stays where it is: is it moved along with the others?");
  check.near("position of pose 0 of " + function, got[0].head<2>(), start[0].head<2>(), 1e-9, "m");
  check.nearAngle("heading of pose 0 of " + function, got[0][2], start[0][2], 1e-9);
}

/// H as a full matrix, after a check that its entries lie within it.
inline Eigen::MatrixXd fullMatrix(rex::grading::Check& check, const std::vector<rex::MatrixEntry>& entries,
                                  int size) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  for (const rex::MatrixEntry& entry : entries) {
    check.that("rows and columns of the entries of H of normalEquations are from 0 to 3 n - 1",
               entry.row >= 0 && entry.row < size && entry.column >= 0 && entry.column < size);
    H(entry.row, entry.column) += entry.value;
  }
  check.shape("H of normalEquations", H, size, size);
  return H;
}

/// The stacked errors of all edges, scaled by the square root of weight and information: their derivatives
/// give H and b without any formula.
inline Eigen::VectorXd weightedErrors(const PoseMap& map, const std::vector<double>& weights,
                                      const Eigen::VectorXd& x) {
  Eigen::VectorXd errors(3 * static_cast<Eigen::Index>(map.edges.size()));
  for (std::size_t number = 0; number < weights.size(); ++number) {
    const MeasuredEdge& edge = map.edges[number];
    // U with U^T U = Omega, by Cholesky's rows.
    Eigen::Matrix3d U = Eigen::Matrix3d::Zero();
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) {
        const double rest = edge.information(row, column) - U.col(row).dot(U.col(column));
        U(row, column) = row == column ? std::sqrt(rest) : rest / U(row, row);
      }
    const Eigen::Vector3d e = trueError(x.segment<3>(3 * edge.from), x.segment<3>(3 * edge.to), edge.motion);
    errors.segment<3>(3 * static_cast<Eigen::Index>(number)) = std::sqrt(weights[number]) * (U * e);
  }
  return errors;
}

inline Eigen::VectorXd numbersOf(const Poses& poses) {
  Eigen::VectorXd x(3 * static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) x.segment<3>(3 * static_cast<Eigen::Index>(k)) = poses[k];
  return x;
}
