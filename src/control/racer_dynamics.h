#pragma once

#include "base/rng.h"
#include "control/linearized_plant.h"

namespace rex {

/// An inverted pendulum on a wheel, exercises 12.6.1 and 12.12: body A is the wheel, B the pendulum. q =
/// (x, theta), with theta measured from upright towards +x; states are (x, theta, x', theta'). u is the
/// motor torque, which drives the wheel forwards and the pendulum backwards. Methods throw Error for
/// constants that are not positive and numbers that are not finite.
struct RacerDynamics {
  double r = 0.05, l = 0.5;    ///< radius of the wheel; distance from its axis to the centre of B; metres
  double mA = 0.05, mB = 0.5;  ///< kg
  double IA = 3.125e-5, IB = 0.005;  ///< about the centres, kg m^2
  double g = 9.8;                    ///< m/s^2

  /// M(q) q'' + F(q, q') = B u. F is corrected: erratum 34.
  [[nodiscard]] Eigen::Matrix2d massMatrix(const Eigen::Vector2d& q) const;
  [[nodiscard]] Eigen::Vector2d forces(const Eigen::Vector2d& q, const Eigen::Vector2d& v) const;
  [[nodiscard]] Eigen::Vector2d controlDirection() const;

  /// x' under the control u.
  [[nodiscard]] Eigen::Vector4d derivative(const Eigen::Vector4d& x, double u) const;
  /// Its exact derivatives.
  [[nodiscard]] LinearizedPlant linearized(const Eigen::Vector4d& x, double u) const;
  /// Kinetic plus potential energy, joules; the potential energy is zero on the ground.
  [[nodiscard]] double energy(const Eigen::Vector4d& x) const;
  /// The planar poses (x, z, angle) of the wheel and of the pendulum, 3 x 2; angles are measured from the
  /// vertical.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> poses(const Eigen::Vector2d& q) const;

  /// One classic Runge-Kutta step of tau seconds, with constant u.
  [[nodiscard]] Eigen::Vector4d rungeKuttaStep(const Eigen::Vector4d& x, double u, double tau) const;
  /// The same, then adds Gaussian noise with standard deviation sqrt(tau) `noise` to both velocities. Also
  /// throws Error for a negative noise.
  [[nodiscard]] Eigen::Vector4d noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                          Rng& rng) const;
};

}  // namespace rex
