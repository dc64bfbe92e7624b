#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace rex::internal {

inline constexpr double kPi = std::numbers::pi;

/// How far rounding may push an angle across zero or a full turn: such a turn is none.
inline constexpr double kAngleSlack = 1e-12;

/// The root of a number that is negative by rounding alone is zero; of others that are negative there is
/// none.
inline bool squareRoot(double square, double& root) {
  constexpr double kSlack = 1e-12;
  if (!(square >= -kSlack)) return false;
  root = square > 0 ? std::sqrt(square) : 0;
  return true;
}

/// A pose to drive to, seen from the car and measured in turning radii.
struct CarGoal {
  double x = 0, y = 0, heading = 0;
  double cosine = 1, sine = 0;  ///< of the heading

  /// Throws as dubinsCurve.
  static CarGoal between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

  /// The same task with left and right, or with forward and backward exchanged.
  CarGoal mirrored() const { return {x, -y, -heading, cosine, -sine}; }
  CarGoal reversed() const { return {-x, y, -heading, cosine, -sine}; }
  /// The way home from the goal, driven backward: its word is that of the way there, read from behind.
  CarGoal fromBehind() const { return {x * cosine + y * sine, x * sine - y * cosine, heading, cosine, sine}; }
};

/// An angle in [0, 2 pi).
inline double fullTurn(double angle) {
  const double turned = angle - 2 * kPi * std::floor(angle / (2 * kPi));
  return turned > 2 * kPi - kAngleSlack ? 0 : turned;
}

/// An angle in (-pi, pi].
inline double halfTurn(double angle) {
  const double turned = angle - 2 * kPi * std::ceil((angle - kPi) / (2 * kPi));
  return turned < -kPi + kAngleSlack ? kPi : turned;
}

}  // namespace rex::internal
