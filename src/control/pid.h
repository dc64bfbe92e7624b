#pragma once

#include <limits>
#include <optional>

namespace rex {

/// Gains of the law u = Kp e + Ki int e + Kd e' for the error e = q* - q. Slide 3:16.
struct PidGains {
  double Kp = 0, Ki = 0, Kd = 0;
};

/// Whether PID control with these gains brings a point of that mass (kg) to rest at its target: whether all
/// roots of m s^3 + Kd s^2 + Kp s + Ki have a negative real part. By Routh: all gains positive and Kp Kd >
/// m Ki; without Ki it is enough that Kp and Kd are positive. Throws Error for a mass that is not positive,
/// and gains that are not finite.
[[nodiscard]] bool pidIsStable(double mass, const PidGains& gains);

struct PidOptions {
  PidGains gains{};
  /// Limits of u. While u is at one, the integral does not grow towards it (anti-windup by conditional
  /// integration, which has no number to tune).
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  double filterTime = 0;  ///< seconds over which differences of the error are smoothed; 0: not at all
};

/// PID control of one coordinate; an arm has one for each joint, because each needs gains of its own. Slides
/// 3:7 to 3:16.
class Pid {
 public:
  /// Throws Error for gains that are not finite, limits that leave nothing, or a negative filter time.
  explicit Pid(const PidOptions& options);

  /// The force for the error e = q* - q and its velocity v* - v, held for h seconds, over which the integral
  /// then grows by h e. Throws Error for h <= 0, numbers that are not finite, and where the force or the
  /// integral would not be; nothing has changed then.
  double step(double error, double velocityError, double h);
  /// The same for those who measure no velocity: by differences of the error, smoothed by a filter of first
  /// order. The first step after a reset() has no difference yet, and takes it to be zero.
  double step(double error, double h);
  /// Forgets the integral and the past.
  void reset();

  /// What the error has added up to.
  [[nodiscard]] double integral() const { return integral_; }

 private:
  PidOptions options_;
  double integral_ = 0;
  double slope_ = 0;  // smoothed
  std::optional<double> lastError_;
};

}  // namespace rex
