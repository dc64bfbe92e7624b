#include "control/racer_rollouts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "control/racer_policy_internal.h"
#include "control/racer_rollouts_internal.h"
#include "systems/racer_kernel.h"

namespace rex {
namespace {

using internal::RacerRolloutsTask;

internal::RacerRolloutsRules rulesOf(const RacerRolloutOptions& options) {
  requireCount("racer: steps", options.steps, 0);
  requirePositive("racer: time step tau", options.tau);
  requireNotNegative("racer: noise", options.noise);
  requirePositive("racer: limit of u", options.largestControl);
  requirePositive("racer: largest angle", options.largestAngle);
  const RacerCost& cost = options.cost;
  requireFinite("racer: weights of the cost",
                Eigen::Matrix<double, 5, 1>(cost.x, cost.theta, cost.gyro, cost.wheel, cost.failure));
  return {.dynamics = internal::racerNumbers(options.dynamics),
          .sensors = internal::racerSensorNumbers(options.sensors, options.dynamics.r),
          .xCost = cost.x,
          .thetaCost = cost.theta,
          .gyroCost = cost.gyro,
          .wheelCost = cost.wheel,
          .failureCost = cost.failure,
          .steps = options.steps,
          .tau = options.tau,
          .deviation = std::sqrt(options.tau) * options.noise,
          .largestControl = options.largestControl,
          .largestAngle = options.largestAngle};
}

void requireTrials(const std::vector<Trial>& trials) {
  for (std::size_t k = 0; k < trials.size(); ++k) {
    if (!trials[k].start.allFinite())
      requireFinite(fmt::format("racer: start of trial {}", k), trials[k].start);
  }
}

void fillLane(const RacerFeatures& features, const VectorArg& w, const Trial& trial, int lane,
              RacerRolloutsTask& task) {
  internal::placeWeights(features, w, &task.weights[0][lane], RacerRolloutsTask::kBlock);
  for (int i = 0; i < RacerRolloutsTask::kStates; ++i) task.start[i][lane] = trial.start[i];
  const Rng rng(trial.seed);
  for (std::size_t i = 0; i < RacerRolloutsTask::kWords; ++i) task.random[i][lane] = rng.state()[i];
}

}  // namespace

Rollouts internal::racerRollouts(const RacerRolloutsKernel& kernel, const MatrixArg& W,
                                 const std::vector<Trial>& trials, const RacerRolloutOptions& options) {
  const RacerRolloutsRules rules = rulesOf(options);
  requireSize("racer: weights of features, a column", W.rows(), options.features.count());
  for (const auto& w : W.colwise()) rex::requireFinite("racer: weights of features", w);
  requireTrials(trials);

  const Eigen::Index rows = static_cast<Eigen::Index>(trials.size()), count = rows * W.cols();
  Rollouts result{.cost = Eigen::MatrixXd(rows, W.cols()), .steps = Eigen::MatrixXi(rows, W.cols())};
  RacerRolloutsTask task;
  for (Eigen::Index begin = 0; begin < count; begin += RacerRolloutsTask::kBlock) {
    // The last block is filled up with the last rollout.
    for (int lane = 0; lane < RacerRolloutsTask::kBlock; ++lane) {
      const Eigen::Index k = std::min(begin + lane, count - 1);
      fillLane(options.features, W.col(k / rows), trials[static_cast<std::size_t>(k % rows)], lane, task);
    }
    kernel.run(rules, task);
    for (Eigen::Index k = begin; k < std::min(begin + RacerRolloutsTask::kBlock, count); ++k) {
      result.cost(k % rows, k / rows) = task.cost[k - begin];
      result.steps(k % rows, k / rows) = static_cast<int>(task.steps[k - begin]);
    }
  }
  return result;
}

Rollouts racerRollouts(const MatrixArg& W, const std::vector<Trial>& trials,
                       const RacerRolloutOptions& options) {
  return internal::racerRollouts(kernelFor<internal::RacerRolloutsKernel>(cpuLanes()), W, trials, options);
}

}  // namespace rex
