#pragma once

#include <cstdint>

#include "base/rng.h"
#include "systems/linearized_plant.h"
#include "systems/racer_sensors.h"

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

/// Settings of a simulated Racer.
struct RacerOptions {
  double tau = 0.01;   ///< seconds per step
  double noise = 0.1;  ///< each step adds normals of standard deviation sqrt(tau) * noise to both velocities
  RacerDynamics dynamics{};
  RacerSensors sensors{};
};

/// The inverted pendulum on a wheel of exercises 12.6.1 and 12.12. The same seed gives the same noise as in
/// the Trial of racerRollouts() with that seed. Methods throw Error for numbers that are not finite,
/// including those in `q` and `v`.
class Racer {
 public:
  /// Throws Error for options out of range.
  explicit Racer(std::uint64_t seed = 0, const RacerOptions& options = {});

  Eigen::Vector2d q{0, 0.01};  ///< x of the wheel, metres; theta of the pendulum, radians from upright
  Eigen::Vector2d v{0, 0};     ///< their velocities

  const RacerOptions& options() const { return options_; }
  /// (x, theta, x', theta').
  [[nodiscard]] Eigen::Vector4d getState() const { return {q[0], q[1], v[0], v[1]}; }
  void setState(const Eigen::Vector4d& x);
  /// One Runge-Kutta step under the torque u (N m), then noise: RacerDynamics::noisyStep.
  void stepDynamics(double u);
  /// M, F and B of M q'' + F = B u at the present state.
  void getDynamics(Eigen::MatrixXd& M, Eigen::VectorXd& F, Eigen::VectorXd& B) const;
  /// A and B of x' = A x + B u, linearised at rest in the upright position.
  [[nodiscard]] LinearizedPlant getLinearization() const {
    return options_.dynamics.linearized(Eigen::Vector4d::Zero(), 0);
  }
  /// Joules.
  [[nodiscard]] double getEnergy() const { return options_.dynamics.energy(getState()); }
  /// The present readings of the sensors, y0 to y3: RacerSensors::measured.
  [[nodiscard]] Eigen::Vector4d getObservation() const;
  /// dy/dx, 4 x 4, where x is the state.
  [[nodiscard]] Eigen::Matrix4d getObservationJacobian() const;

 private:
  RacerOptions options_;
  Rng rng_;
};

}  // namespace rex
