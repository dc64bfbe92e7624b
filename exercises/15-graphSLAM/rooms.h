#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "exercise.h"

// Rooms seen from above, what a range scanner sees in them, and the walk of main().

/// A straight wall from one point to another, metres.
struct WallLine {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
};
using Building = std::vector<WallLine>;

inline void addWall(Building& building, double x1, double y1, double x2, double y2) {
  building.push_back({{x1, y1}, {x2, y2}});
}

inline void addBox(Building& building, double x, double y, double width, double height) {
  addWall(building, x, y, x + width, y);
  addWall(building, x + width, y, x + width, y + height);
  addWall(building, x + width, y + height, x, y + height);
  addWall(building, x, y + height, x, y);
}

/// Metres from p along the angle to the first wall, at most `most`.
inline double rangeOf(const Building& building, const Eigen::Vector2d& p, double angle, double most) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  double nearest = most;
  for (const WallLine& wall : building) {
    const double ax = wall.from.x() - p.x(), ay = wall.from.y() - p.y();
    const double wx = wall.to.x() - wall.from.x(), wy = wall.to.y() - wall.from.y();
    const double across = dx * wy - dy * wx;
    if (std::abs(across) < 1e-12) continue;
    const double way = (ax * wy - ay * wx) / across, share = (ax * dy - ay * dx) / across;
    if (way > 0 && share >= 0 && share <= 1) nearest = std::min(nearest, way);
  }
  return nearest;
}

/// A scan of 150 rays from a pose (x, y, heading), with noise of 2 cm; rays longer than 8 m give no point.
inline Points scanFrom(const Building& building, const Eigen::Vector3d& pose, rex::Rng& rng) {
  constexpr int kRays = 150;
  constexpr double kMost = 8;
  Points points;
  for (int k = 0; k < kRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRays;
    const double range = rangeOf(building, {pose[0], pose[1]}, pose[2] + angle, kMost);
    const double measured = range + 0.02 * rng.normal();
    if (range < kMost) points.emplace_back(measured * std::cos(angle), measured * std::sin(angle));
  }
  return points;
}

/// The building of main(): 18 m x 12 m around a block, with things along the way.
inline Building house() {
  Building building;
  addBox(building, 0, 0, 18, 12);
  addBox(building, 4, 4, 10, 4);
  addBox(building, 0, 0, 1.5, 0.8);
  addBox(building, 6, 0, 1.2, 1);
  addBox(building, 11, 3, 0.9, 1);
  addBox(building, 16.6, 1.2, 1.4, 0.8);
  addBox(building, 17, 7, 1, 1.6);
  addBox(building, 9, 11.2, 1.6, 0.8);
  addBox(building, 5.5, 8, 0.8, 0.9);
  addBox(building, 0, 5, 0.7, 1.4);
  addWall(building, 0, 10.5, 1.6, 12);
  addWall(building, 16, 12, 18, 10.6);
  return building;
}

/// Where a robot was, and what it saw there.
struct Walk {
  std::vector<Eigen::Vector3d> truth;
  std::vector<Points> scans;
};

/// One and a quarter rounds through the house, with poses about 0.9 m apart.
inline Walk walkThroughHouse(rex::Rng& rng) {
  const std::array<std::array<double, 2>, 4> corners{{{2, 2.1}, {15.8, 2.3}, {15.6, 9.8}, {2.2, 9.6}}};
  const Building building = house();
  Walk walk;
  for (std::size_t side = 0; side < 5; ++side) {
    const auto &a = corners[side % 4], &b = corners[(side + 1) % 4];
    const double east = b[0] - a[0], north = b[1] - a[1];
    const int steps = static_cast<int>(std::hypot(east, north) / 0.9);
    for (int k = 0; k < steps; ++k)
      walk.truth.emplace_back(a[0] + east * k / steps, a[1] + north * k / steps,
                              std::atan2(north, east) + rng.uniform(-0.1, 0.1));
  }
  for (const Eigen::Vector3d& pose : walk.truth) walk.scans.push_back(scanFrom(building, pose, rng));
  return walk;
}
