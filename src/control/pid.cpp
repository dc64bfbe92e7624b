#include "control/pid.h"

#include <algorithm>

#include "control/require_internal.h"

namespace rex {
namespace {

void requireGains(const PidGains& gains) {
  internal::requireFinite("gain Kp", gains.Kp);
  internal::requireFinite("gain Ki", gains.Ki);
  internal::requireFinite("gain Kd", gains.Kd);
}

}  // namespace

bool pidIsStable(double mass, const PidGains& gains) {
  internal::requirePositive("mass", mass);
  requireGains(gains);
  const bool isDamped = gains.Kp > 0 && gains.Kd > 0;
  return isDamped && gains.Ki >= 0 && gains.Kp * gains.Kd > mass * gains.Ki;
}

Pid::Pid(const PidOptions& options) : options_(options) {
  requireGains(options.gains);
  internal::requireNotNegative("filter time", options.filterTime);
  if (!(options.lowest < options.highest))
    throw Error({.what = "limits of u",
                 .found = fmt::format("{:g} to {:g}", options.lowest, options.highest),
                 .wanted = "the lower one first"});
}

double Pid::step(double error, double velocityError, double h) {
  internal::requireFinite("error", error);
  internal::requireFinite("velocity error", velocityError);
  internal::requirePositive("time step h", h);
  const PidGains& gains = options_.gains;
  const double wished = gains.Kp * error + gains.Ki * integral_ + gains.Kd * velocityError;
  const double u = std::clamp(wished, options_.lowest, options_.highest);
  const double push = gains.Ki * error;
  const bool windsUp = (wished > u && push > 0) || (wished < u && push < 0);
  if (!windsUp) integral_ += h * error;
  return u;
}

double Pid::step(double error, double h) {
  internal::requireFinite("error", error);
  internal::requirePositive("time step h", h);
  // Backward Euler of filterTime slope' + slope = e': stable for every h.
  if (lastError_) slope_ += ((error - *lastError_) - h * slope_) / (options_.filterTime + h);
  lastError_ = error;
  return step(error, slope_, h);
}

void Pid::reset() {
  integral_ = slope_ = 0;
  lastError_.reset();
}

}  // namespace rex
