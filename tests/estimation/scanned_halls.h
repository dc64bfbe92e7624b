#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/rng.h"
#include "estimation/building.h"
#include "estimation/scan_matching.h"
#include "street_graph.h"

namespace rex::test {

inline RangeScanner scannerOf(int rays, double maxRange) {
  RangeScanner scanner{.maxRange = maxRange};
  for (int i = 0; i < rays; ++i) scanner.angles.push_back(2 * std::numbers::pi * i / rays);
  return scanner;
}

/// What a scanner at a pose (x, y, heading) reads, with normal noise, as points in its frame.
inline Eigen::Matrix2Xd scanOf(const Building& building, const RangeScanner& scanner,
                               const Eigen::Vector3d& pose, double noise, Rng& rng) {
  return scanPoints(scanner, noisyRanges(building, scanner, pose, noise, rng));
}

/// One room with things in it, 8 x 6 m, without symmetry.
inline Building room() {
  Building building;
  building.addBox(0, 0, 8, 6);
  building.addBox(5, 3.5, 1.5, 0.8);
  building.addBox(1, 4.5, 0.7, 0.7);
  building.walls.push_back({3, 0, 3, 1.5});
  building.walls.push_back({6.5, 0, 8, 1.2});
  return building;
}

/// A hall of 24 x 16 m around a block with things along the way, so that a walk around it comes back; without
/// the things of its own in each corner, the two rooms at its long sides look alike.
inline Building hall() {
  Building building;
  building.addBox(0, 0, 24, 16);
  building.addBox(5, 5, 14, 6);
  for (const double side : {0., 1.}) {  // the same room at both long sides, turned by half a turn
    const auto place = [side](double x, double y) {
      return side > 0 ? Eigen::Vector2d(24 - x, 16 - y) : Eigen::Vector2d(x, y);
    };
    for (const auto& [x1, y1, x2, y2] : {std::array{9., 0., 9., 1.4},
                                         {9., 3.2, 9., 5.},
                                         {15., 0., 15., 1.4},
                                         {15., 3.2, 15., 5.},
                                         {11., 0., 11.8, 0.9},
                                         {13., 5., 13., 4.2}}) {
      Eigen::Vector4d wall;
      wall << place(x1, y1), place(x2, y2);
      building.walls.push_back(wall);
    }
  }
  building.addBox(0, 0, 1.5, 0.7);
  building.addBox(20, 2, 0.8, 1.1);
  building.addBox(23, 12, 1, 1.6);
  building.addBox(1.6, 9, 0.6, 0.6);
  building.walls.push_back({0, 13, 2, 16});
  building.walls.push_back({19, 16, 20.5, 14.5});
  return building;
}

/// A walk in a building: where the robot was, what its odometry says, and what it saw.
struct Walk {
  Eigen::Matrix3Xd truth{};
  PlanarPoseGraph odometry{};
  std::vector<Eigen::Matrix2Xd> scans{};
};

/// `rounds` times around the block of the hall, from pose to pose by about 0.8 m, with odometry that drifts.
inline Walk walkAround(const Building& building, double rounds, Rng& rng, double noise = 0.02) {
  const std::vector<Eigen::Vector2d> corners{{2.8, 2.4}, {21.2, 2.4}, {21.2, 13.4}, {2.8, 13.4}};
  Walk walk;
  std::vector<Eigen::Vector3d> poses;
  const int sides = static_cast<int>(4 * rounds);
  for (int side = 0; side < sides; ++side) {
    const Eigen::Vector2d &a = corners[static_cast<std::size_t>(side % 4)],
                          &b = corners[static_cast<std::size_t>((side + 1) % 4)];
    const int steps = static_cast<int>((b - a).norm() / 0.8);
    for (int k = 0; k < steps; ++k) {
      const Eigen::Vector2d p = a + (b - a) * k / steps;
      poses.emplace_back(p.x() + rng.uniform(-.15, .15), p.y() + rng.uniform(-.15, .15),
                         wrapAngle(std::atan2(b.y() - a.y(), b.x() - a.x()) + rng.uniform(-.1, .1)));
    }
  }
  const RangeScanner scanner = scannerOf(120, 8);
  const Eigen::Vector3d deviations(.04, .04, .03);
  walk.truth.resize(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    walk.truth.col(static_cast<Eigen::Index>(k)) = poses[k];
    walk.scans.push_back(scanOf(building, scanner, poses[k], noise, rng));
    if (k == 0) continue;
    const Eigen::Vector3d motion =
        planarMotion(poses[k - 1], poses[k]) + deviations.cwiseProduct(rng.normalVector(3));
    walk.odometry.edges.push_back({static_cast<int>(k) - 1, static_cast<int>(k), motion,
                                   deviations.cwiseAbs2().cwiseInverse().asDiagonal()});
  }
  walk.odometry.poses = walk.truth;
  setOdometryPoses(walk.odometry);
  return walk;
}

/// Root mean square distance of positions; both start at the same pose.
inline double mapError(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return std::sqrt((a - b).topRows<2>().squaredNorm() / static_cast<double>(a.cols()));
}

}  // namespace rex::test
