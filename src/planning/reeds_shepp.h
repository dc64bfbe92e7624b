#pragma once

#include "planning/curve.h"

namespace rex {

/// The shortest way between two poses for a car that may also drive backward, with turns no tighter than
/// `radius`, among all words of Reeds and Shepp. Slide 4:61; Reeds and Shepp, Optimal paths for a car that
/// goes both forwards and backwards, 1990. Throws as dubinsCurve.
[[nodiscard]] Curve reedsSheppCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Its length, metres; faster than the curve. A metric: symmetric, and with the triangle inequality.
[[nodiscard]] double reedsSheppLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

}  // namespace rex
