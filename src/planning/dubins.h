#pragma once

#include "planning/curve.h"

namespace rex {

// Poses are (x, y, heading), metres and radians. All functions throw Error for a pose that is not finite and
// a radius that is not positive and finite.

/// The shortest path between two poses for a car that only drives forward, with turns no tighter than
/// `radius`: the best of the words LSL, LSR, RSL, RSR, LRL, RLR. Slide 4:60; Dubins 1957; Shkel and
/// Lumelsky 2001.
[[nodiscard]] Curve dubinsCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Only its length, metres; faster than computing the curve.
[[nodiscard]] double dubinsLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

}  // namespace rex
