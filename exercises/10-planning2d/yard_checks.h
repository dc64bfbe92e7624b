#pragma once

#include <algorithm>

#include "exercise.h"

// What the checks of parts 3 and 4 know about yards.

inline Eigen::Vector2d randomPlace(const Yard& yard, rex::Rng& rng) {
  return {rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y())};
}

inline Eigen::Vector2d randomFreePlace(const Yard& yard, rex::Rng& rng) {
  while (true) {
    const Eigen::Vector2d p = randomPlace(yard, rng);
    if (isFree(yard, p)) return p;
  }
}

// Blocks with corners on a grid of that spacing: gaps between them are at least that wide.
inline Yard randomYard(rex::Rng& rng, const Eigen::Vector2d& size, int blocks, double raster) {
  Yard yard{.size = size, .blocks = {}};
  const auto corner = [&](double length) { return raster * rng.index(static_cast<int>(length / raster)); };
  for (int i = 0; i < blocks; ++i) {
    const Eigen::Vector2d lower(corner(size.x()), corner(size.y()));
    yard.blocks.push_back({lower, lower + raster * Eigen::Vector2d(1 + rng.index(3), 1 + rng.index(3))});
  }
  return yard;
}

// The length of the part of the straight way from a to b that lies in a block (or touches it): zero at least,
// negative if there is none.
inline double lengthIn(const Block& block, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double first = 0, last = 1;
  for (int i = 0; i < 2; ++i) {
    const double way = b[i] - a[i];
    if (way == 0) {
      if (a[i] < block.lower[i] || a[i] > block.upper[i]) return -1;
      continue;
    }
    const double one = (block.lower[i] - a[i]) / way, other = (block.upper[i] - a[i]) / way;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first > last ? -1 : (last - first) * (b - a).norm();
}

// What a straight way between free positions is: blocked, if points at that spacing must hit a block; free,
// if it keeps off all blocks; otherwise either answer is accepted.
enum class Straight { kFree, kEither, kBlocked };
inline Straight judged(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       double resolution) {
  Straight result = Straight::kFree;
  for (const auto& [lower, upper] : yard.blocks) {
    const Eigen::Vector2d rim = Eigen::Vector2d::Constant(1e-9);
    const double length = lengthIn({lower - rim, upper + rim}, a, b);
    if (length > resolution * (1 + 1e-6) + 1e-8) return Straight::kBlocked;
    if (length >= 0) result = Straight::kEither;
  }
  return result;
}

// The corners of blocks, one block in a row: lower x and y, upper x and y.
inline Eigen::MatrixXd cornersOf(const Yard& yard) {
  Eigen::MatrixXd corners(yard.blocks.size(), 4);
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const Block& block = yard.blocks[static_cast<std::size_t>(i)];
    corners.row(i) << block.lower.transpose(), block.upper.transpose();
  }
  return corners;
}
