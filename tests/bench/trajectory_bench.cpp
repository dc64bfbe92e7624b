#include <algorithm>
#include <list>
#include <memory>

#include "bench/arm_trajectory.h"
#include "bench/cluttered_arm.h"
#include "bench/cpu_seconds.h"
#include "bench/row.h"

namespace rex::bench {
namespace {

Measurement solving(int steps, bool hasObstacle) {
  const auto arm = std::make_shared<const ArmTrajectory>(steps, hasObstacle);
  (void)solve(*arm);  // throws where it is not solved
  return timed([arm] { (void)solve(*arm); });
}

// Ten problems, each from three starts. All are made, solved and judged by the first measurement of either
// row.
class Clutter {
 public:
  // The mean over all starts, seconds.
  double seconds() {
    makeAll();
    const double start = cpuSeconds();
    for (const ClutteredArm& arm : arms_)
      for (const Eigen::MatrixXd& from : arm.starts) static_cast<void>(solve(arm, from));
    return (cpuSeconds() - start) / static_cast<double>(3 * arms_.size());
  }
  // The share of problems that no start solves, and that of starts.
  double missedProblems() {
    makeAll();
    return missedProblems_ / static_cast<double>(arms_.size());
  }
  double missedStarts() {
    makeAll();
    return missedStarts_ / static_cast<double>(3 * arms_.size());
  }

 private:
  void makeAll() {
    if (!arms_.empty()) return;
    Rng rng(1);
    for (int k = 0; k < 10; ++k) {
      const ClutteredArm& arm = arms_.emplace_back(randomClutteredTask(rng), rng);
      const auto missed = std::ranges::count_if(
          arm.starts, [&](const auto& from) { return !isRight(arm, solve(arm, from)); });
      missedStarts_ += static_cast<double>(missed);
      missedProblems_ += missed == 3 ? 1 : 0;
    }
  }

  std::list<ClutteredArm> arms_;  // whose problems point to their models
  double missedProblems_ = 0, missedStarts_ = 0;
};

}  // namespace

std::vector<Row> trajectoryRows() {
  constexpr double kLimit = 30e-3;  // seconds
  const auto clutter = std::make_shared<Clutter>();
  return {{.name = "trajectory-400-steps",
           .ours = solving(400, false),
           .peerName = "100 steps",
           .peer = solving(100, false),
           .target = 5,
           .unit = "ms"},
          {.name = "trajectory-obstacle",
           .ours = solving(100, true),
           .peerName = "limit",
           .peer = [] { return kLimit; },
           .target = 1,
           .unit = "ms"},
          {.name = "trajectory-cluttered",
           .ours = [=] { return clutter->seconds(); },
           .unit = "ms",
           .repetitions = 3},
          {.name = "trajectory-cluttered-missed",
           .ours = [=] { return clutter->missedProblems(); },
           .unit = "%",
           .repetitions = 1},
          {.name = "trajectory-cluttered-missed-starts",
           .ours = [=] { return clutter->missedStarts(); },
           .unit = "%",
           .repetitions = 1}};
}

}  // namespace rex::bench
