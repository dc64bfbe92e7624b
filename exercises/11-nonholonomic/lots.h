#pragma once

#include <cmath>
#include <numbers>

#include "exercise.h"

// Worlds that the checks draw at random, each at a random pose.

inline Eigen::Vector3d moved(const Eigen::Vector3d& X_WL, const Eigen::Vector3d& q) {
  const double c = std::cos(X_WL[2]), s = std::sin(X_WL[2]);
  return {X_WL[0] + c * q[0] - s * q[1], X_WL[1] + s * q[0] + c * q[1], X_WL[2] + q[2]};
}

/// The same world elsewhere. The bounds become those of its turned rectangle.
inline World placed(World world, const Eigen::Vector3d& X_WL) {
  const Eigen::Vector2d low = world.lower, high = world.upper;
  world.lower.setConstant(1e9);
  world.upper.setConstant(-1e9);
  for (const double x : {low.x(), high.x()})
    for (const double y : {low.y(), high.y()}) {
      const Eigen::Vector2d corner = moved(X_WL, {x, y, 0}).head<2>();
      world.lower = world.lower.cwiseMin(corner);
      world.upper = world.upper.cwiseMax(corner);
    }
  world.start = moved(X_WL, world.start);
  world.goal = moved(X_WL, world.goal);
  for (Block& block : world.blocks) block.middle = moved(X_WL, block.middle);
  return world;
}

/// Walls around the rectangle from lower to upper.
inline void fence(World& world) {
  const Eigen::Vector2d middle = (world.lower + world.upper) / 2, size = world.upper - world.lower;
  for (const double side : {-0.5, 0.5}) {
    world.blocks.push_back(
        {{middle.x() + side * (size.x() + 0.4), middle.y(), std::numbers::pi / 2}, size.y() + 0.8, 0.4});
    world.blocks.push_back({{middle.x(), middle.y() + side * (size.y() + 0.4), 0}, size.x() + 0.8, 0.4});
  }
}

/// Rows of parked cars along a street in the direction of x, with one space left: between two cars at the
/// kerb on the right side, `gap` longer than the car.
inline World streetLot(rex::Rng& rng, double width, double gap) {
  World lot;
  const double slot = 4.4 + gap;
  lot.lower = {-16, -1.2};
  lot.upper = {16, width};
  lot.goal = {-1.3, 0, rng.uniform(-0.02, 0.02)};
  for (const double side : {-1., 1.})
    for (int i = 0; i < 2; ++i)
      lot.blocks.push_back(
          {{side * (slot / 2 + 2.2 + 5.2 * i), rng.uniform(-0.1, 0.1), rng.uniform(-0.03, 0.03)}, 4.2, 1.75});
  lot.start = {rng.uniform(-10, 6), rng.uniform(2.8, width - 1.7), rng.uniform(-0.2, 0.2)};
  fence(lot);
  return lot;
}

/// Spaces side by side, across the street; one is free. `outwards`: the car must face the street.
inline World bayLot(rex::Rng& rng, double width, bool outwards) {
  World lot;
  const double pitch = rng.uniform(2.5, 2.8);
  lot.lower = {-14, -2.5};
  lot.upper = {14, width + 2.5};
  const double turn = std::numbers::pi / 2 * (outwards ? 1 : -1);
  lot.goal = {0, outwards ? -1.3 : 1.3, turn + rng.uniform(-0.02, 0.02)};
  for (const int i : {-3, -2, -1, 1, 2, 3})
    lot.blocks.push_back(
        {{i * pitch, rng.uniform(-0.15, 0.15), std::numbers::pi / 2 + rng.uniform(-0.04, 0.04)}, 4.2, 1.75});
  lot.start = {rng.uniform(-9, 5), rng.uniform(3.9, width + 0.5), rng.uniform(-0.2, 0.2)};
  fence(lot);
  return lot;
}

/// The same with left and right exchanged.
inline World mirrored(World world) {
  const auto mirror = [](Eigen::Vector3d& q) { q = {q[0], -q[1], -q[2]}; };
  mirror(world.start);
  mirror(world.goal);
  for (Block& block : world.blocks) mirror(block.middle);
  const double low = world.lower.y();
  world.lower.y() = -world.upper.y();
  world.upper.y() = -low;
  return world;
}

/// A random pose.
inline Eigen::Vector3d anywhere(rex::Rng& rng) {
  return {rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-3.14, 3.14)};
}
