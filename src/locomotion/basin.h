#pragma once

#include <vector>

#include "locomotion/limit_cycle.h"

namespace rex {

struct BasinOptions {
  int maxSteps = 50;        ///< of each walker
  double tolerance = 1e-3;  ///< reached if no entry of the state differs by more from the cycle's
  double timeLimit = 10;    ///< seconds of each step
};

/// The outcome of one walk.
struct BasinOutcome {
  enum class Status {
    kReached,   ///< came within the tolerance once
    kFell,      ///< see `last`
    kUndecided  ///< walks on, but not into the cycle: converges too slowly, or to another gait
  };
  Status status = Status::kUndecided;
  StepStatus last = StepStatus::kStepped;  ///< how its last step ended
  int steps = 0;                           ///< whole steps until then
};

/// Finds out which starts lead into a limit cycle by walking from each column of `starts` (4 x N, states of
/// CompassGait after an impact). One outcome per column. Throws Error like CompassGait, for a cycle that
/// was not found or is not stable, as it attracts nothing, and for options that are not positive.
[[nodiscard]] std::vector<BasinOutcome> basinOfAttraction(const CompassGait& walker, const LimitCycle& cycle,
                                                          const Eigen::Ref<const Eigen::Matrix4Xd>& starts,
                                                          const BasinOptions& options = {});

/// Starts on a grid of stance angles and rates (radians, rad/s), stance angle varying fastest, with both
/// feet on the ground and the cycle's swing rate scaled with the stance rate: 4 x (angles * rates) states.
/// Throws Error for a cycle that was not found.
[[nodiscard]] Eigen::Matrix4Xd basinGrid(const CompassGait& walker, const LimitCycle& cycle,
                                         const Eigen::Ref<const Eigen::VectorXd>& stanceAngles,
                                         const Eigen::Ref<const Eigen::VectorXd>& stanceRates);

}  // namespace rex
