#pragma once

#include <Eigen/Core>

namespace rex {

/// Position and velocity of a centre of mass seen from above: x and y in W, metres and m/s.
struct CenterMotion {
  Eigen::Vector2d c{0, 0}, v{0, 0};
};

/// The linear inverted pendulum: a centre of mass at constant height above level ground, without angular
/// momentum about it, so c'' = omega^2 (c - p) for the zero moment point p (slide 11:12; Kajita et al.
/// 2001, The 3D linear inverted pendulum mode). Both axes behave alike and independently. All functions
/// throw Error for a height or g that is not positive, and for numbers that are not finite.
struct InvertedPendulum {
  double height = 0.8;  ///< of the centre of mass above the ground, metres
  double g = 9.81;      ///< m/s^2

  /// sqrt(g / height), 1/s.
  [[nodiscard]] double omega() const;
  /// c'', m/s^2, for the zero moment point p (x and y in W, metres).
  [[nodiscard]] Eigen::Vector2d acceleration(const Eigen::Vector2d& c, const Eigen::Vector2d& p) const;
  /// p for an acceleration: the inverse of the above.
  [[nodiscard]] Eigen::Vector2d zmp(const Eigen::Vector2d& c, const Eigen::Vector2d& acceleration) const;
  /// The motion t seconds later with constant p, in closed form. t may be negative.
  [[nodiscard]] CenterMotion after(const CenterMotion& start, const Eigen::Vector2d& p, double t) const;
  /// c + v / omega: the only constant p that brings the motion to rest, above that p. Pratt et al. 2006,
  /// Capture point.
  [[nodiscard]] Eigen::Vector2d capturePoint(const CenterMotion& at) const;
  /// v^2 / 2 - omega^2 (c - p)^2 / 2 for each axis, J/kg: constant while p is. If negative, the motion
  /// turns back before it passes p.
  [[nodiscard]] Eigen::Vector2d orbitalEnergy(const CenterMotion& at, const Eigen::Vector2d& p) const;
};

}  // namespace rex
