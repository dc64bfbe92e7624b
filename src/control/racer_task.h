#pragma once

#include <vector>

#include "control/racer_rollouts.h"
#include "learning/linear_gaussian_policy.h"

namespace rex {

/// The racer of exercise 12.12 as a task for policy gradients, which also need to know the noise of each
/// control: rewards are the negative costs of racerRollouts with the same options, where a failure costs all
/// missing steps at once, and actions are clipped. Episodes start in one of `starts`, (x, theta, x', theta').
/// Throws Error like racerRollouts, and without starts.
[[nodiscard]] ControlTask racerTask(const std::vector<Eigen::Vector4d>& starts,
                                    const RacerRolloutOptions& options = {});

}  // namespace rex
