#pragma once

#include <cstdint>

#include "systems/racer_kernel.h"

namespace rex::internal {

/// Rollouts side by side, in plain numbers. Arrays are [number][lane].
struct RacerRolloutsTask {
  static constexpr int kBlock = 8;
  static constexpr int kWeights = 27, kStates = 4, kWords = 4;

  double weights[kWeights][kBlock];  ///< of all features
  double start[kStates][kBlock];
  std::uint64_t random[kWords][kBlock];  ///< states of Rng
  double cost[kBlock], steps[kBlock];    ///< results
};

/// What holds for all of them.
struct RacerRolloutsRules {
  RacerNumbers dynamics;
  RacerSensorNumbers sensors;
  double xCost, thetaCost, gyroCost, wheelCost, failureCost;
  int steps;
  double tau, deviation;  ///< deviation: of the noise of a step
  double largestControl, largestAngle;
};

struct RacerRolloutsKernel {
  void (*run)(const RacerRolloutsRules& rules, RacerRolloutsTask& task);

  template <int kLanes>
  static RacerRolloutsKernel compiled();
};

}  // namespace rex::internal
