#include "estimation/scan_walk.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex {

Eigen::Matrix3Xd posesAlong(const std::vector<Eigen::Vector2d>& points, double step, double turn) {
  requireCount("points of the walk", static_cast<long long>(points.size()), 2);
  requirePositive("step of the walk", step, kMetres);
  requirePositive("turn of the walk", turn, kRadians);
  std::vector<Eigen::Vector3d> poses;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d way = points[i + 1] - points[i];
    requireFinite("length of the walk", way.norm(), kMetres);
    if (way.norm() == 0)
      throw Error({.what = fmt::format("points {} and {} of the walk", i, i + 1),
                   .found = "the same position",
                   .wanted = "different ones"});
    const double heading = std::atan2(way.y(), way.x());
    if (i == 0) poses.emplace_back(points[0].x(), points[0].y(), heading);
    const Eigen::Vector3d from = poses.back();
    const double angle = wrapAngle(heading - from[2]);
    const int turns = static_cast<int>(std::ceil(std::abs(angle) / turn - 1e-9));
    for (int k = 1; k <= turns; ++k)
      poses.emplace_back(from[0], from[1], wrapAngle(from[2] + angle * k / turns));
    const int steps = static_cast<int>(std::ceil(way.norm() / step - 1e-9));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector2d p = points[i] + way * k / steps;
      poses.emplace_back(p.x(), p.y(), heading);
    }
  }
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = poses[i];
  return result;
}

ScanWalk measured(const Building& building, const Eigen::Matrix3Xd& poses, const RangeScanner& scanner,
                  const WalkNoise& noise, Rng& rng) {
  requireNotNegative("deviations of the odometry", noise.odometry);
  ScanWalk walk{.truth = poses, .odometry = Eigen::Matrix3Xd::Zero(3, poses.cols())};
  walk.ranges.resize(static_cast<Eigen::Index>(scanner.angles.size()), poses.cols());
  for (Eigen::Index k = 0; k < poses.cols(); ++k) {
    walk.ranges.col(k) = noisyRanges(building, scanner, poses.col(k), noise.range, rng);
    if (k == 0) continue;
    const Eigen::Vector3d from = poses.col(k - 1), way = poses.col(k) - from;
    const Eigen::Matrix2d R = internal::planarRotation(from[2]);
    walk.odometry.col(k) << R.transpose() * way.head<2>(), wrapAngle(way[2]);
    walk.odometry.col(k) += noise.odometry.cwiseProduct(rng.normalVector(3));
  }
  return walk;
}

Eigen::Vector3d movedPose(const Eigen::Vector3d& pose, const Eigen::Vector3d& motion) {
  Eigen::Vector3d next;
  next << pose.head<2>() + internal::planarRotation(pose[2]) * motion.head<2>(),
      wrapAngle(pose[2] + motion[2]);
  return next;
}

PoseTransition odometryTransition(const Eigen::Vector3d& motion, const Eigen::Vector3d& deviations) {
  requireFinite("measured motion", motion);
  requireNotNegative("deviations of the odometry", deviations);
  if (deviations[0] != deviations[1])
    throw Error({.what = "deviations of the odometry",
                 .found = fmt::format("{:g} m in x, {:g} m in y", deviations[0], deviations[1]),
                 .wanted = "the same in both"});
  return {.mean = [motion](const Eigen::Vector3d& x) { return movedPose(x, motion); },
          .jacobian =
              [motion](const Eigen::Vector3d& x) {
                Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
                const Eigen::Vector2d way = internal::planarRotation(x[2]) * motion.head<2>();
                A.topRightCorner<2, 1>() << -way.y(), way.x();
                return A;
              },
          .noise = deviations.cwiseAbs2().asDiagonal()};
}

}  // namespace rex
