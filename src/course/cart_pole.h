#pragma once

#include <cstdint>

#include "control/cart_pole_dynamics.h"

namespace rex {

/// Settings of a simulated CartPole.
struct CartPoleOptions {
  double tau = 1. / 60;  ///< seconds per step
  double noise = 0.1;    ///< standard deviation of the noise that each step adds to both velocities
  CartPoleDynamics dynamics{};
};

/// The cart pole of exercise 12.11. Methods throw Error for numbers that are not finite, including those in
/// `x`.
class CartPole {
 public:
  /// Throws Error for options out of range.
  explicit CartPole(std::uint64_t seed = 0, const CartPoleOptions& options = {});

  /// The state (p, p', theta, theta'): position in metres from the middle of the rail, angle in radians
  /// from upright.
  Eigen::Vector4d x{0, 0, 0.2, 0};

  const CartPoleOptions& options() const { return options_; }
  /// One explicit Euler step under the force u (N), then noise: CartPoleDynamics::noisyStep.
  void step(double u) { x = options_.dynamics.noisyStep(x, u, options_.tau, options_.noise, rng_); }
  /// A and B of x' = A x + B u, linearised at rest in the upright position.
  [[nodiscard]] LinearizedPlant getLinearization() const {
    return options_.dynamics.linearized(Eigen::Vector4d::Zero(), 0);
  }
  /// Joules.
  [[nodiscard]] double getEnergy() const { return options_.dynamics.energy(x); }

 private:
  CartPoleOptions options_;
  Rng rng_;
};

}  // namespace rex
