#pragma once

namespace rex {

/// Gains of the law u = Kp (q* - q) + Kd (v* - v). Slide 3:10.
struct PdGains {
  double Kp = 0, Kd = 0;
};

/// Gains that make a point of that mass (kg) behave like a spring of wave length lambda > 0 (seconds; one
/// oscillation takes 2 pi lambda) and damping ratio xi >= 0: Kp = m / lambda^2, Kd = 2 m xi / lambda. Below
/// xi = 1 it oscillates, at 1 it is critically damped, above over-damped. Slide 3:14. Throws Error naming the
/// number that is out of range, also where a gain would overflow.
[[nodiscard]] PdGains pdGains(double mass, double lambda, double xi);

}  // namespace rex
