#pragma once

#include "base/rng.h"
#include "control/linearized_plant.h"

namespace rex {

/// A pole that stands on a cart, as of slide 8:1 and exercise 12.11: the pole is an even rod, `l` from the
/// hinge to its middle. States are (x, x', theta, theta'), theta from upright towards x; u is the force on
/// the cart. Methods throw Error for constants that are not positive, and numbers that are not finite.
struct CartPoleDynamics {
  double poleMass = 1, cartMass = 1;  ///< kg
  double l = 1;                       ///< metres
  double g = 9.8;                     ///< m/s^2

  [[nodiscard]] double c1() const { return 1 / (poleMass + cartMass); }
  [[nodiscard]] double c2() const { return l * poleMass * c1(); }

  /// x' by equations (13) and (14) of exercise 12.11.
  [[nodiscard]] Eigen::Vector4d derivative(const Eigen::Vector4d& x, double u) const;
  /// Its exact derivatives; at rest upright those of errata 11a.
  [[nodiscard]] LinearizedPlant linearized(const Eigen::Vector4d& x, double u) const;
  /// Kinetic and potential energy, joules; the latter is zero with the pole level.
  [[nodiscard]] double energy(const Eigen::Vector4d& x) const;

  /// One explicit Euler step of tau seconds: positions move with the velocities before it.
  [[nodiscard]] Eigen::Vector4d eulerStep(const Eigen::Vector4d& x, double u, double tau) const;
  /// The same, and then both velocities change by normal numbers of deviation `noise`, whatever tau. Throws
  /// Error also for a negative noise.
  [[nodiscard]] Eigen::Vector4d noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                          Rng& rng) const;
};

}  // namespace rex
