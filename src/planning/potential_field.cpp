#include "planning/potential_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

std::string described(const Eigen::Vector2d& p) { return fmt::format("({:g}, {:g})", p.x(), p.y()); }

}  // namespace

PotentialField::PotentialField(const GridMap& map, const Eigen::Vector2d& goal,
                               const PotentialFieldOptions& options)
    : map_(map), goal_(goal), options_(options) {
  requirePositive("attraction", options.attraction);
  requirePositive("repulsion", options.repulsion);
  requirePositive("reach of obstacles", options.reach);
  if (!std::isfinite(potential(goal)))
    throw Error({.what = "goal", .found = described(goal), .wanted = "a position outside obstacles"});
}

PotentialField::Obstacle PotentialField::nearestObstacle(const Eigen::Vector2d& p) const {
  Obstacle nearest{options_.reach, Eigen::Vector2d::Zero()};
  const Eigen::Vector2d corner = Eigen::Vector2d::Constant(options_.reach);
  const GridCell low = map_.cellAt(p - corner), high = map_.cellAt(p + corner);
  const double half = map_.cellSize() / 2;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!map_.contains({x, y}) || !map_.isBlocked({x, y})) continue;
      const Eigen::Vector2d center = map_.center({x, y}), ofCenter = p - center;
      const Eigen::Vector2d away = ofCenter - ofCenter.cwiseMax(-half).cwiseMin(half);
      const double distance = away.norm();
      if (distance >= nearest.distance) continue;
      nearest = {distance, distance > 0 ? Eigen::Vector2d(away / distance) : Eigen::Vector2d::Zero()};
    }
  }
  return nearest;
}

double PotentialField::potential(const Eigen::Vector2d& p) const {
  const double distance = nearestObstacle(p).distance;
  if (!(distance > 0)) return std::numeric_limits<double>::infinity();
  const double nearness = 1 / distance - 1 / options_.reach;
  return .5 * options_.attraction * (p - goal_).squaredNorm() + .5 * options_.repulsion * nearness * nearness;
}

Eigen::Vector2d PotentialField::gradient(const Eigen::Vector2d& p) const {
  const auto [distance, direction] = nearestObstacle(p);
  const double nearness = 1 / distance - 1 / options_.reach;
  return options_.attraction * (p - goal_) -
         options_.repulsion * nearness / (distance * distance) * direction;
}

Descent descend(const PotentialField& field, const Eigen::Vector2d& start, double stepSize, int maxSteps) {
  requirePositive("step size", stepSize);
  if (!std::isfinite(field.potential(start)))
    throw Error({.what = "start", .found = described(start), .wanted = "a position outside obstacles"});
  Descent descent{.points = {start}};
  const double least = 1e-6 * stepSize;
  Eigen::Vector2d at = start;
  for (int i = 0; i < maxSteps; ++i) {
    if ((at - field.goal()).norm() <= stepSize) {
      descent.status = DescentStatus::kReached;
      return descent;
    }
    const Eigen::Vector2d gradient = field.gradient(at);
    const double slope = gradient.norm(), here = field.potential(at);
    double step = stepSize;
    const auto next = [&] { return Eigen::Vector2d(at - step / slope * gradient); };
    while (slope > 0 && step > least && !(field.potential(next()) < here)) step /= 2;
    if (slope == 0 || step <= least) {
      descent.status = DescentStatus::kLocalMinimum;
      return descent;
    }
    at = next();
    descent.points.push_back(at);
  }
  return descent;
}

}  // namespace rex
