#pragma once

#include <cstdint>

#include "control/racer_dynamics.h"
#include "control/racer_sensors.h"

namespace rex {

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
