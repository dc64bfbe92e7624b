#pragma once

#include <limits>
#include <optional>

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

/// Gains of the control law u = Kp e + Ki int e + Kd e' for the error e = q* - q. Slide 3:16.
struct PidGains {
  double Kp = 0, Ki = 0, Kd = 0;
};

/// Whether PID control with these gains brings a point mass (kg) to rest at its target, that is, whether
/// all roots of m s^3 + Kd s^2 + Kp s + Ki have negative real parts. By Routh's criterion all gains must be
/// positive and Kp Kd > m Ki; without Ki it suffices that Kp and Kd are positive. Throws Error for a mass
/// that is not positive and gains that are not finite.
[[nodiscard]] bool pidIsStable(double mass, const PidGains& gains);

struct PidOptions {
  PidGains gains{};
  /// Limits of u. While u is at a limit, the integral does not grow further towards it (anti-windup by
  /// conditional integration, which needs no tuning).
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  double filterTime = 0;  ///< time constant of the filter of error differences, seconds; 0: none
};

/// PID control of one coordinate. An arm has one for each joint, because each joint needs its own gains.
/// Slides 3:7 to 3:16.
class Pid {
 public:
  /// Throws Error for gains that are not finite, limits without a range between them, or a negative filter
  /// time.
  explicit Pid(const PidOptions& options);

  /// The force for the error e = q* - q and its derivative v* - v, to be held for h seconds. Then the
  /// integral grows by h e. Throws Error for h <= 0, numbers that are not finite, and if the force or the
  /// integral would not be finite; the state is unchanged then.
  double step(double error, double velocityError, double h);
  /// The same without a measured velocity: uses differences of the error, smoothed by a first-order filter.
  /// In the first step after a reset() the difference is taken to be zero.
  double step(double error, double h);
  /// Forgets the integral and the last error.
  void reset();

  /// The integral of the error.
  [[nodiscard]] double integral() const { return integral_; }

 private:
  PidOptions options_;
  double integral_ = 0;
  double slope_ = 0;  // smoothed
  std::optional<double> lastError_;
};

}  // namespace rex
