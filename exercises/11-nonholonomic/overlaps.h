#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "lots.h"

// What the body of a car touches, by a method other than that of the solution.

/// Rectangles overlap unless one lies wholly beyond a side of the other. This tests corner by corner; the
/// solution compares projections.
inline bool overlap(const CarModel& car, const Eigen::Vector3d& q, const Block& block) {
  const auto corners = [](const Eigen::Vector3d& X, double back, double front, double half) {
    std::array<Eigen::Vector2d, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = moved(X, {i == 0 || i == 3 ? -back : front, i < 2 ? -half : half, 0}).head<2>();
    return p;
  };
  const auto a = corners(q, car.back, car.front, car.width / 2);
  const auto b = corners(block.middle, block.length / 2, block.length / 2, block.width / 2);
  const auto separates = [](const auto& of, const auto& from) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d side = of[(i + 1) % 4] - of[i];
      if (std::ranges::all_of(from, [&](const Eigen::Vector2d& p) {
            return side.x() * (p.y() - of[i].y()) - side.y() * (p.x() - of[i].x()) < 0;
          }))
        return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

inline bool touches(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  return std::ranges::any_of(blocks, [&](const Block& block) {
    const double farthest = car.front + car.width + (block.length + block.width) / 2;
    return (block.middle - q).head<2>().norm() < farthest && overlap(car, q, block);
  });
}

/// A car that is smaller, or larger, on all sides.
inline CarModel grown(CarModel car, double by) {
  car.front += by;
  car.back += by;
  car.width += 2 * by;
  return car;
}
