#pragma once

#include <Eigen/Core>

namespace rex {

/// The sensor model of a racer with the state (x, theta, x', theta'), identified from recordings of the
/// real one: two accelerometers on the body (in units of g), a gyroscope (rad/s), and an encoder between
/// wheel and body (rad). Methods throw Error for numbers that are not finite.
struct RacerSensors {
  double s = 1.021875;          ///< accelerometer reading for 1 g
  double phi = 0.16;            ///< their mounting angle on the body, rad
  double kappa = 0.0510417;     ///< their distance from the wheel's axis divided by g, s^2
  double gyroBias = 0.0417273;  ///< rad/s

  /// y0 = s cos(theta + phi) - kappa theta'^2 cos phi, y1 = s sin(theta + phi) - kappa theta'^2 sin phi,
  /// y2 = theta' - gyroBias, y3 = x / r - theta, for wheels of radius r (metres; Error unless positive).
  [[nodiscard]] Eigen::Vector4d measured(const Eigen::Vector4d& x, double r) const;
  /// dy/dx, 4 x 4. Throws like measured.
  [[nodiscard]] Eigen::Matrix4d jacobian(const Eigen::Vector4d& x, double r) const;
};

}  // namespace rex
