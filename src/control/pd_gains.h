#pragma once

namespace rex {

/// Gains of the control law u = Kp (q* - q) + Kd (v* - v). Slide 3:10.
struct PdGains {
  double Kp = 0, Kd = 0;
};

/// Gains that make a point mass (kg) behave like a spring of wave length lambda > 0 (seconds; one
/// oscillation takes 2 pi lambda) and damping ratio xi >= 0: Kp = m / lambda^2, Kd = 2 m xi / lambda. It
/// oscillates for xi < 1, is critically damped for xi = 1 and overdamped above. Slide 3:14. Throws Error
/// naming the number that is out of range, also if a gain would overflow.
[[nodiscard]] PdGains pdGains(double mass, double lambda, double xi);

}  // namespace rex
