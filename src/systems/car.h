#pragma once

#include <Eigen/Core>

namespace rex {

/// A car with its reference point between the rear wheels: q = (x, y, heading), u = (speed, steering angle).
/// Slide 4:48 with erratum 10.
struct Car {
  double wheelbase = 1;      ///< L, metres between the axles
  double maxSteering = 0.7;  ///< largest |phi|, below pi / 2
  /// Radius of the tightest circle that the reference point can drive: L / tan(maxSteering).
  [[nodiscard]] double turningRadius() const;
};

/// q' = (v cos heading, v sin heading, v / L tan phi). Throws Error for a wheelbase that is not positive,
/// and a steering angle beyond maxSteering.
[[nodiscard]] Eigen::Vector3d carVelocity(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u);

/// One Euler step of tau seconds with the heading at its start, and any steering angle: q + tau q'.
[[nodiscard]] Eigen::Vector3d eulerStepCar(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u,
                                           double tau);

/// The pose after `seconds` with constant u: exact, on an arc or a line. Throws like carVelocity.
[[nodiscard]] Eigen::Vector3d driveCar(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u,
                                       double seconds);

/// The sideways slip of a motion: xdot sin(heading) - ydot cos(heading), m/s. It is zero for cars: slide
/// 4:49.
[[nodiscard]] double sidewaysSpeed(const Eigen::Vector3d& q, const Eigen::Vector3d& velocity);

/// A car that pulls a trailer, hitched between its rear wheels; q = (x, y, heading, heading of the
/// trailer). Slide 4:57.
struct CarWithTrailer {
  Car car{};
  double hitchLength = 1;  ///< from the hitch to the trailer's axle, metres
};

/// Like carVelocity; the trailer turns with the rate v / d sin(heading - heading of the trailer).
[[nodiscard]] Eigen::Vector4d trailerVelocity(const CarWithTrailer& rig, const Eigen::Vector4d& q,
                                              const Eigen::Vector2d& u);

/// The state of both after `seconds` with constant u: exact. Throws like carVelocity.
[[nodiscard]] Eigen::Vector4d driveTrailer(const CarWithTrailer& rig, const Eigen::Vector4d& q,
                                           const Eigen::Vector2d& u, double seconds);

/// The angle a = heading - heading of the trailer of a car on an arc: a' = k - sin(a) / d per metre.
struct Hitch {
  double hitchLength = 1;  ///< d, metres

  /// After `way` metres on an arc of this curvature k (1/m); exact, full turns are counted.
  [[nodiscard]] double angle(double a, double curvature, double way) const;
  /// The derivatives of that angle by a, curvature and way.
  [[nodiscard]] Eigen::Vector3d slopes(double a, double curvature, double way) const;
};

}  // namespace rex
