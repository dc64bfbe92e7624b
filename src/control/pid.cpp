#include "control/pid.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "control/require_internal.h"

namespace rex {

PdGains pdGains(double mass, double lambda, double xi) {
  requirePositive("mass", mass);
  requirePositive("wave length lambda", lambda);
  requireNotNegative("damping ratio xi", xi);
  const PdGains gains{.Kp = mass / (lambda * lambda), .Kd = 2 * mass * xi / lambda};
  internal::requireFinite(gains);
  return gains;
}

namespace {

void requireGains(const PidGains& gains) {
  requireFinite("gain Kp", gains.Kp);
  requireFinite("gain Ki", gains.Ki);
  requireFinite("gain Kd", gains.Kd);
}

}  // namespace

bool pidIsStable(double mass, const PidGains& gains) {
  requirePositive("mass", mass);
  requireGains(gains);
  const bool isDamped = gains.Kp > 0 && gains.Kd > 0;
  // Long doubles, because products of tiny numbers would vanish, and those of large ones overflow.
  const long double damping = static_cast<long double>(gains.Kp) * gains.Kd;
  return isDamped && gains.Ki >= 0 && damping > static_cast<long double>(mass) * gains.Ki;
}

Pid::Pid(const PidOptions& options) : options_(options) {
  requireGains(options.gains);
  requireNotNegative("filter time", options.filterTime);
  if (!(options.lowest < options.highest))
    throw Error({.what = "limits of u",
                 .found = fmt::format("{:g} to {:g}", options.lowest, options.highest),
                 .wanted = "the lower one first"});
}

double Pid::step(double error, double velocityError, double h) {
  requireFinite("error", error);
  requireFinite("velocity error", velocityError);
  requirePositive("time step h", h);
  const PidGains& gains = options_.gains;
  const double wished = gains.Kp * error + gains.Ki * integral_ + gains.Kd * velocityError;
  const double u = std::clamp(wished, options_.lowest, options_.highest);
  const double push = gains.Ki * error;
  const bool windsUp = (wished > u && push > 0) || (wished < u && push < 0);
  const double integral = windsUp ? integral_ : integral_ + h * error;
  requireFinite("force u", u);
  requireFinite("integral of the error", integral);
  integral_ = integral;
  return u;
}

double Pid::step(double error, double h) {
  requireFinite("error", error);
  requirePositive("time step h", h);
  // Backward Euler of filterTime slope' + slope = e': stable for every h.
  const double change = lastError_ ? error - *lastError_ - h * slope_ : 0;
  const double slope = slope_ + change / (options_.filterTime + h);
  requireFinite("difference of the last two errors, per second", slope);
  const double u = step(error, slope, h);
  slope_ = slope;
  lastError_ = error;
  return u;
}

void Pid::reset() {
  integral_ = slope_ = 0;
  lastError_.reset();
}

}  // namespace rex
