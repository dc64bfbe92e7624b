#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/car_goal_internal.h"

namespace rex::internal {

CarGoal CarGoal::between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  for (const Eigen::Vector3d& pose : {from, to}) {
    if (!pose.allFinite()) {
      throw Error({.what = "pose of a car",
                   .found = fmt::format("({:g}, {:g}, {:g})", pose[0], pose[1], pose[2]),
                   .wanted = "x, y and heading as finite numbers"});
    }
  }
  requirePositive("turning radius", radius, kMetres);
  const double c = std::cos(from[2]), s = std::sin(from[2]);
  const double dx = (to[0] - from[0]) / radius, dy = (to[1] - from[1]) / radius;
  const double heading = to[2] - from[2];
  return {c * dx + s * dy, c * dy - s * dx, heading, std::cos(heading), std::sin(heading)};
}

}  // namespace rex::internal
