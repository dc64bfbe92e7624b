#pragma once

#include "planning/curve.h"

namespace rex {

/// The shortest path between two poses for a car that may also drive backward, with turns no tighter than
/// `radius`, among all words of Reeds and Shepp. Slide 4:61; Reeds and Shepp, Optimal paths for a car that
/// goes both forwards and backwards, 1990. Throws like dubinsCurve.
[[nodiscard]] Curve reedsSheppCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Only its length, metres; faster than computing the curve. It is a metric: symmetric, and satisfies the
/// triangle inequality.
[[nodiscard]] double reedsSheppLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

}  // namespace rex
