#pragma once

#include <numbers>
#include <vector>

#include "base/vector_arg.h"
#include "control/cart_pole_dynamics.h"
#include "control/rollouts.h"

namespace rex {

/// How cart poles are rolled out. A step costs tau (x^T Q x + R u^2), with the state it starts from; noise
/// is then added as in CartPoleDynamics::noisyStep.
struct CartPoleRolloutOptions {
  Eigen::Matrix4d Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal();
  double R = 1;
  double failure = 10;  ///< cost of each step that is missing after a failure
  int steps = 3000;     ///< 50 s
  double tau = 1. / 60, noise = 0.1;
  double largestAngle = std::numbers::pi / 2;  ///< rad; beyond it, or if not finite, the pole has fallen
  CartPoleDynamics dynamics{};
};

/// Rolls out the policies u = w . x, one per column of W (4 x N), in all trials. Throws Error like
/// noisyStep, for a W of the wrong size, negative steps, and numbers that are not finite.
[[nodiscard]] Rollouts cartPoleRollouts(const MatrixArg& W, const std::vector<Trial>& trials,
                                        const CartPoleRolloutOptions& options = {});

}  // namespace rex
