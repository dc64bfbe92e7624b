#include "control/racer_task.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "control/racer_policy_internal.h"
#include "control/racer_policy_kernel_internal.h"

namespace rex {
namespace {

// A state of the task: that of the racer, the number of steps so far, and all features, taken or not.
constexpr int kAllFeatures = internal::kRacerFeatures, kTaskStates = 4 + 1 + kAllFeatures;

// The state of the task in x, from the features in the state before; without one, the episode begins.
Eigen::VectorXd taskState(const RacerRolloutOptions& o, const Eigen::Vector4d& x, double step,
                          const double* past) {
  double y[internal::kRacerSensors], features[kAllFeatures];
  Eigen::Vector4d::Map(y) = o.sensors.measured(x, o.dynamics.r);
  if (past)
    std::copy_n(past, kAllFeatures, features);
  else
    internal::beginFeatures(y, features);
  internal::advanceFeatures(y, 1 / o.tau, features);
  Eigen::VectorXd state(kTaskStates);
  state << x, step, Eigen::Map<const Eigen::VectorXd>(features, kAllFeatures);
  return state;
}

ControlTask::Outcome afterAction(const RacerRolloutOptions& o, Eigen::VectorXd state, double action,
                                 Rng& rng) {
  const double u = std::clamp(action, -o.largestControl, o.largestControl), step = state[4];
  const Eigen::Vector4d x = o.dynamics.noisyStep(state.head<4>(), u, o.tau, o.noise, rng);
  double* features = state.data() + 5;
  features[internal::kControlPlace + 1] = features[internal::kControlPlace];
  features[internal::kControlPlace] = u;
  ControlTask::Outcome outcome{.next = taskState(o, x, step + 1, features)};
  outcome.failed = std::abs(x[1]) > o.largestAngle;
  const Eigen::Vector4d squares(o.cost.x, o.cost.theta, o.cost.gyro, o.cost.wheel);
  const double* y = outcome.next.data() + 5 + internal::kSensorPlace;
  outcome.reward = outcome.failed ? -o.cost.failure * (o.steps - step)
                                  : -squares.dot(Eigen::Vector4d(x[0], x[1], y[2], y[3]).cwiseAbs2());
  return outcome;
}

}  // namespace

ControlTask racerTask(const std::vector<Eigen::Vector4d>& starts, const RacerRolloutOptions& options) {
  if (starts.empty()) throw Error({.what = "racer: starts", .found = "none"});
  std::vector<Trial> trials;
  for (const Eigen::Vector4d& start : starts) trials.push_back({.start = start});
  const int count = options.features.count();
  static_cast<void>(racerRollouts(Eigen::MatrixXd(count, 0), trials, options));  // refuses what is wrong
  // Weights 1, 2, ... say which feature comes where.
  double order[kAllFeatures];
  internal::placeWeights(options.features, Eigen::VectorXd::LinSpaced(count, 1, count), order, 1);
  std::vector<int> taken;
  for (int i = 0; i < kAllFeatures; ++i)
    if (order[i] > 0) taken.push_back(5 + i);
  return {.start =
              [=](Rng& rng) {
                const int k = rng.index(static_cast<int>(starts.size()));
                return taskState(options, starts[static_cast<std::size_t>(k)], 0, nullptr);
              },
          .features = [=](const Eigen::VectorXd& state) -> Eigen::VectorXd { return state(taken); },
          .step = [=](const Eigen::VectorXd& state, double action,
                      Rng& rng) { return afterAction(options, state, action, rng); },
          .horizon = options.steps};
}

}  // namespace rex
