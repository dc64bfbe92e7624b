#include <memory>

#include "bench/arm_trajectory.h"
#include "bench/row.h"

namespace rex::bench {
namespace {

Measurement solving(int steps, bool hasObstacle) {
  const auto arm = std::make_shared<const ArmTrajectory>(steps, hasObstacle);
  (void)solve(*arm);  // throws where it is not solved
  return timed([arm] { (void)solve(*arm); });
}

}  // namespace

std::vector<Row> trajectoryRows() {
  constexpr double kLimit = 30e-3;  // seconds
  return {{.name = "trajectory-obstacle",
           .ours = solving(100, true),
           .peerName = "limit",
           .peer = [] { return kLimit; },
           .target = 1,
           .unit = "ms"}};
}

}  // namespace rex::bench
