#pragma once

#include <cstdint>

#include "base/rng.h"
#include "systems/linearized_plant.h"

namespace rex {

/// A pole hinged on a cart, as in slide 8:1 and exercise 12.11. The pole is a uniform rod, `l` from the
/// hinge to its centre. States are (x, x', theta, theta') with theta measured from upright towards +x; u is
/// the force on the cart. Methods throw Error for constants that are not positive and for numbers that are
/// not finite.
struct CartPoleDynamics {
  double poleMass = 1, cartMass = 1;  ///< kg
  double l = 1;                       ///< metres
  double g = 9.8;                     ///< m/s^2

  [[nodiscard]] double c1() const { return 1 / (poleMass + cartMass); }
  [[nodiscard]] double c2() const { return l * poleMass * c1(); }

  /// x' from equations (13) and (14) of exercise 12.11.
  [[nodiscard]] Eigen::Vector4d derivative(const Eigen::Vector4d& x, double u) const;
  /// Its exact derivatives; at the upright rest position they are those of erratum 32.
  [[nodiscard]] LinearizedPlant linearized(const Eigen::Vector4d& x, double u) const;
  /// Kinetic plus potential energy, joules; the potential energy is zero when the pole is horizontal.
  [[nodiscard]] double energy(const Eigen::Vector4d& x) const;

  /// One explicit Euler step of tau seconds: positions move with the velocities before the step.
  [[nodiscard]] Eigen::Vector4d eulerStep(const Eigen::Vector4d& x, double u, double tau) const;
  /// The same, then adds Gaussian noise to both velocities, with standard deviation `noise` whatever tau
  /// is. Also throws Error for a negative noise.
  [[nodiscard]] Eigen::Vector4d noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                          Rng& rng) const;
};

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
