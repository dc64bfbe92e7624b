#pragma once

#include <Eigen/Core>

namespace rex {

/// What a racer measures of its state (x, theta, x', theta'), recovered from recordings of the real one: two
/// accelerometers on the body (in units of g), a gyroscope (rad/s), and an encoder between wheel and body
/// (rad). Methods throw Error for numbers that are not finite.
struct RacerSensors {
  double s = 1.021875;          ///< what the accelerometers read of 1 g
  double phi = 0.16;            ///< how they are turned against the body, rad
  double kappa = 0.0510417;     ///< their distance from the wheel's axis over g, s^2
  double gyroBias = 0.0417273;  ///< rad/s

  /// y0 = s cos(theta + phi) - kappa theta'^2 cos phi, y1 = s sin(theta + phi) - kappa theta'^2 sin phi,
  /// y2 = theta' - gyroBias, y3 = x / r - theta, for wheels of radius r (metres; Error unless positive).
  [[nodiscard]] Eigen::Vector4d measured(const Eigen::Vector4d& x, double r) const;
  /// dy/dx. Throws as measured.
  [[nodiscard]] Eigen::Matrix4d jacobian(const Eigen::Vector4d& x, double r) const;
};

}  // namespace rex
