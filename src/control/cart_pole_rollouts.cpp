#include "control/cart_pole_rollouts.h"

#include <cmath>

#include "base/error.h"
#include "base/require.h"
#include "control/cart_pole_step_internal.h"
#include "control/require_internal.h"
#include "control/require_trials_internal.h"

namespace rex {
namespace {

void requireOptions(const CartPoleRolloutOptions& options) {
  requireCount("cart pole: steps", options.steps, 0);
  requirePositive("cart pole: time step tau", options.tau);
  requireNotNegative("cart pole: noise", options.noise);
  requirePositive("cart pole: largest angle", options.largestAngle);
  requireFinite("cart pole: costs Q", options.Q.reshaped());
  requireFinite("cart pole: costs R", options.R);
  requireFinite("cart pole: cost of a failure", options.failure);
  (void)options.dynamics.derivative(Eigen::Vector4d::Zero(), 0);  // throws for bad constants
}

struct Rollout {
  double cost = 0;
  int steps = 0;
};

Rollout rollOut(const Eigen::Vector4d& w, const Trial& trial, const CartPoleRolloutOptions& options) {
  const internal::CartPoleNumbers numbers = internal::cartPoleNumbers(options.dynamics);
  Rng rng(trial.seed);
  Rollout result;
  for (Eigen::Vector4d x = trial.start; result.steps < options.steps; ++result.steps) {
    const double u = w.dot(x);
    const Eigen::Vector4d next = internal::withCartPoleNoise(
        x + options.tau * internal::cartPoleDerivative(numbers, x, u), options.noise, rng);
    if (!next.allFinite() || std::abs(next[2]) > options.largestAngle) break;
    result.cost += options.tau * (x.dot(options.Q * x) + options.R * u * u);
    x = next;
  }
  result.cost += options.failure * (options.steps - result.steps);
  return result;
}

}  // namespace

Rollouts cartPoleRollouts(const MatrixArg& W, const std::vector<Trial>& trials,
                          const CartPoleRolloutOptions& options) {
  requireOptions(options);
  requireSize("cart pole: gains, a column", W.rows(), 4);
  for (const auto& w : W.colwise()) requireFinite("cart pole: gains", w);
  internal::requireTrials("cart pole", trials);

  const Eigen::Index rows = static_cast<Eigen::Index>(trials.size());
  Rollouts result{.cost = Eigen::MatrixXd(rows, W.cols()), .steps = Eigen::MatrixXi(rows, W.cols())};
  for (Eigen::Index policy = 0; policy < W.cols(); ++policy) {
    for (Eigen::Index k = 0; k < rows; ++k) {
      const Rollout one = rollOut(W.col(policy), trials[static_cast<std::size_t>(k)], options);
      result.cost(k, policy) = one.cost;
      result.steps(k, policy) = one.steps;
    }
  }
  return result;
}

}  // namespace rex
