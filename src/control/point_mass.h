#pragma once

#include "control/pid.h"

namespace rex {

/// Position and velocity of a point on a line: metres, m/s.
struct PointMassState {
  double q = 0, v = 0;
};

/// A mass (kg) on a line, without friction or gravity. Slide 3:6.
struct PointMass {
  double mass = 1;
  /// One explicit Euler step of h seconds under force u (N): q' = q + h v, v' = v + h u / m. Throws Error
  /// for a mass or h that is not positive and for numbers that are not finite.
  [[nodiscard]] PointMassState eulerStep(const PointMassState& at, double u, double h) const;
};

/// The exact motion of a point mass under u = Kp (target - q) - Kd v, t seconds after `start`: slides 3:8
/// to 3:14. Accurate in all three regimes, and also close to xi = 1. Throws Error like eulerStep, for t <
/// 0, and if an intermediate result overflows.
[[nodiscard]] PointMassState pdResponse(const PointMass& point, const PdGains& gains,
                                        const PointMassState& start, double target, double t);

}  // namespace rex
