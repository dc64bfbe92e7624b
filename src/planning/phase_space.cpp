#include "planning/phase_space.h"

#include "base/require.h"

namespace rex {
namespace {

// The multipliers p = G^-1 d of the optimal force u(t) = (T - t) p0 + p1.
Eigen::Vector2d multipliers(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration) {
  requirePositive("duration of a motion", duration, kSeconds);
  requireFinite("state in phase space", from);
  requireFinite("state in phase space", to);
  const double T = duration, position = to[0] - from[0] - T * from[1], velocity = to[1] - from[1];
  return {12 / (T * T * T) * position - 6 / (T * T) * velocity, 4 / T * velocity - 6 / (T * T) * position};
}

}  // namespace

double leastEffort(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration) {
  const Eigen::Vector2d missing(to[0] - from[0] - duration * from[1], to[1] - from[1]);
  return missing.dot(multipliers(from, to, duration));
}

double leastEffortForce(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration, double t) {
  requireFinite("time of a motion", t);
  const Eigen::Vector2d p = multipliers(from, to, duration);
  return (duration - t) * p[0] + p[1];
}

Eigen::Vector2d leastEffortState(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double duration,
                                 double t) {
  requireFinite("time of a motion", t);
  const Eigen::Vector2d p = multipliers(from, to, duration);
  const double first = duration * p[0] + p[1];  // the force at the start
  return {from[0] + t * from[1] + t * t / 2 * first - t * t * t / 6 * p[0],
          from[1] + t * first - t * t / 2 * p[0]};
}

}  // namespace rex
