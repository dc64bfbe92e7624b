#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "planning/path_problem.h"

namespace rex::internal {

inline constexpr int kBlock = 8;  // columns, a block of the kernels

/// How many points a way of that length needs so that none is farther than the resolution from the one
/// before. Throws Error for more than 1e8, minutes of work even where a check takes a microsecond.
inline int pointsOn(double length, double resolution) {
  constexpr double kMostPoints = 1e8;
  const double points = std::ceil(length / resolution);
  if (points <= kMostPoints) return std::max(1, static_cast<int>(points));
  throw Error(
      {.what = fmt::format("resolution of a path check: {:g} on a way of length {:g}", resolution, length),
       .found = std::isfinite(length) ? fmt::format("{:g} points", points) : "no finite distance",
       .wanted = fmt::format("a coarser one: at most {:g} points", kMostPoints)});
}

/// A step that visits all of 0 .. count - 1 and never stays near where it was: coprime to count, about .38 of
/// it.
inline int wideStep(int count) {
  int step = std::max(1, static_cast<int>(.382 * count));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

/// Whether the points at the shares 1/points ... 1 of a way are valid, asked for in blocks of kBlock, each
/// spread over the whole way. `pointAt(share, column)` writes a point; `block` is room to work in.
template <class PointAt>
bool isValidSpread(const AllValid& allValid, int points, Eigen::MatrixXd& block, const PointAt& pointAt) {
  const int blocks = (points + kBlock - 1) / kBlock, step = wideStep(blocks);
  for (int i = 0, first = 0; i < blocks; ++i, first = (first + step) % blocks) {
    int filled = 0;
    for (int k = points - first; k > 0; k -= blocks)  // the end belongs to the first block
      pointAt(static_cast<double>(k) / points, block.col(filled++));
    if (!allValid(block.leftCols(filled))) return false;
  }
  return true;
}

}  // namespace rex::internal
