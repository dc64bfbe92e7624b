#pragma once

#include <algorithm>
#include <vector>

#include "exercise.h"

// Worlds with cheap collision tests: the unit square with discs and boxes. Used by main() and by the grader.

struct PlaneDisc {
  Eigen::Vector2d center;
  double radius;
};

struct PlaneBox {
  Eigen::Vector2d lower, upper;
};

struct PlaneWorld {
  std::vector<PlaneDisc> discs{};
  std::vector<PlaneBox> boxes{};
};

/// Whether the straight line from a to b has a point inside a box: some part of it lies in all four half
/// planes at once.
inline bool meets(const PlaneBox& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double first = 0, last = 1;
  for (int i = 0; i < 2; ++i) {
    const double along = b[i] - a[i];
    if (along == 0) {
      if (a[i] <= box.lower[i] || a[i] >= box.upper[i]) return false;
      continue;
    }
    const double one = (box.lower[i] - a[i]) / along, other = (box.upper[i] - a[i]) / along;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first < last;
}

/// Whether the straight line from a to b has a point inside a disc: the point nearest to its centre.
inline bool meets(const PlaneDisc& disc, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a, toCenter = disc.center - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp(toCenter.dot(along) / length2, 0., 1.) : 0;
  return (toCenter - share * along).norm() < disc.radius;
}

/// Whether the straight line from a to b stays in the square and meets no obstacle: exact, not by samples.
inline bool wayIsFree(const PlaneWorld& world, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const auto meetsIt = [&](const auto& obstacle) { return meets(obstacle, a, b); };
  return a.minCoeff() >= 0 && b.minCoeff() >= 0 && a.maxCoeff() <= 1 && b.maxCoeff() <= 1 &&
         std::none_of(world.discs.begin(), world.discs.end(), meetsIt) &&
         std::none_of(world.boxes.begin(), world.boxes.end(), meetsIt);
}

/// The same as an EdgeTest. `slack` widens the gaps, for edges that are free up to rounding since they are
/// parts of free ones.
inline EdgeTest freeIn(PlaneWorld world, double slack = 0) {
  for (PlaneDisc& disc : world.discs) disc.radius -= slack;
  for (PlaneBox& box : world.boxes) {
    box.lower.array() += slack;
    box.upper.array() -= slack;
  }
  return [world](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) { return wayIsFree(world, qa, qb); };
}

inline SearchSettings inThePlane(double stepSize, double goalBias, int maxSamples) {
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1), stepSize, goalBias, maxSamples};
}

inline double lengthOf(const Path& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Two walls, thinner than a step.
inline const PlaneWorld kThinWalls{.boxes = {{{0.3, 0}, {0.32, 0.75}}, {{0.65, 0.25}, {0.67, 1}}}};
inline const Eigen::Vector2d kLowerLeft(0.1, 0.1), kUpperRight(0.9, 0.9);
