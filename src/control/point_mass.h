#pragma once

#include "control/pd_gains.h"

namespace rex {

/// Where a point on a line is, and how fast: metres, m/s.
struct PointMassState {
  double q = 0, v = 0;
};

/// A mass (kg) on a line, without friction or gravity. Slide 3:6.
struct PointMass {
  double mass = 1;
  /// One explicit Euler step of h seconds under force u (N): q' = q + h v, v' = v + h u / m. Throws Error for
  /// a mass or h that is not positive, and numbers that are not finite.
  [[nodiscard]] PointMassState eulerStep(const PointMassState& at, double u, double h) const;
};

/// The exact motion of a point mass under u = Kp (target - q) - Kd v, t seconds after `start`: slides
/// 3:8 to 3:14, in all three regimes, also just beside xi = 1. Throws Error as eulerStep, for t < 0, and
/// where numbers overflow on the way.
[[nodiscard]] PointMassState pdResponse(const PointMass& point, const PdGains& gains,
                                        const PointMassState& start, double target, double t);

}  // namespace rex
