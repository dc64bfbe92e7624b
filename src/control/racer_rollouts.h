#pragma once

#include <cstdint>
#include <vector>

#include "base/require.h"
#include "control/racer_policy.h"
#include "systems/racer.h"
#include "systems/racer_sensors.h"

namespace rex {

/// The initial state of a plant with four states, and the seed of its noise. Comparing policies on the same
/// trials takes luck out of the comparison.
struct Trial {
  Eigen::Vector4d start{0, 0, 0, 0};
  std::uint64_t seed = 0;
};

/// The results of all policies, one per column, in all trials, one per row.
struct Rollouts {
  Eigen::MatrixXd cost{};   ///< summed over the steps, including the cost of failing
  Eigen::MatrixXi steps{};  ///< number of steps survived
};

/// Weights of the squares in the cost of a step, evaluated in the state it leads to.
struct RacerCost {
  double x = 1, theta = 10;    ///< of the state, as in exercise 12.12
  double gyro = 0, wheel = 0;  ///< of y2 and y3: 1 and 0.1 if only the sensors are known
  double failure = 10;         ///< for each step that is missing after a failure
};

/// How racers are rolled out. After each step of tau seconds noise is added as in RacerDynamics::noisyStep.
struct RacerRolloutOptions {
  RacerFeatures features{};
  RacerCost cost{};
  int steps = 500;
  double tau = 0.01, noise = 0.1;
  double largestControl = 5;  ///< N m: controls are clipped to it
  double largestAngle = 0.8;  ///< rad; beyond it the racer has failed
  RacerDynamics dynamics{};
  RacerSensors sensors{};
};

/// Rolls out all policies u = w . features, one per column of W (features x N), in all trials, which start
/// in (x, theta, x', theta'). Each result is bit-identical to a loop over RacerSensors::measured,
/// RacerPolicy::control and RacerDynamics::noisyStep with Rng(seed), in any column and on every CPU. Throws
/// Error like these, for a W of the wrong size, negative steps, and numbers that are not finite.
[[nodiscard]] Rollouts racerRollouts(const MatrixArg& W, const std::vector<Trial>& trials,
                                     const RacerRolloutOptions& options = {});

}  // namespace rex
