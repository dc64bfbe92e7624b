#include "control/point_mass.h"

#include <algorithm>
#include <cmath>

#include "control/require_internal.h"

namespace rex {
namespace {

// The two solutions of e'' + 2 damping e' + stiffness e = 0 that start as (1, -damping) and (0, 1).
struct Modes {
  double c, s;
};

Modes oscillating(double damping, double omega, double t) {
  const double envelope = std::exp(-damping * t);
  return {envelope * std::cos(omega * t), envelope * std::sin(omega * t) / omega};
}

// The rate of greater magnitude is free of cancellation, and the other follows from their product. The form
// of s holds if they are nearly equal.
Modes decaying(double damping, double stiffness, double omega, double t) {
  const double one = damping >= 0 ? -(damping + omega) : omega - damping, other = stiffness / one;
  const double slow = std::exp(std::max(one, other) * t), ratio = std::expm1(-2 * omega * t);
  return {slow * (2 + ratio) / 2, -slow * ratio / (2 * omega)};
}

// damping^2 - stiffness by its factors, because squares of large numbers overflow.
Modes modesAt(double damping, double stiffness, double t) {
  const double size = std::abs(damping), frequency = std::sqrt(std::abs(stiffness));
  if (stiffness < 0) return decaying(damping, stiffness, std::hypot(damping, frequency), t);
  const double root = std::sqrt(std::abs(size - frequency)) * std::sqrt(size + frequency);
  if (size < frequency) return oscillating(damping, root, t);
  if (size > frequency) return decaying(damping, stiffness, root, t);
  const double envelope = std::exp(-damping * t);
  return {envelope, envelope * t};
}

void requireState(const PointMass& point, const PointMassState& at) {
  requirePositive("mass", point.mass);
  requireFinite("position q", at.q);
  requireFinite("velocity v", at.v);
}

}  // namespace

PointMassState PointMass::eulerStep(const PointMassState& at, double u, double h) const {
  requireState(*this, at);
  requireFinite("force u", u);
  requirePositive("time step h", h);
  return {.q = at.q + h * at.v, .v = at.v + h * u / mass};
}

PointMassState pdResponse(const PointMass& point, const PdGains& gains, const PointMassState& start,
                          double target, double t) {
  requireState(point, start);
  internal::requireFinite(gains);
  requireFinite("target", target);
  requireNotNegative("time t", t);
  const double damping = gains.Kd / point.mass / 2, stiffness = gains.Kp / point.mass;
  const double e = start.q - target;
  const auto [c, s] = modesAt(damping, stiffness, t);
  const PointMassState end{.q = target + e * c + (start.v + damping * e) * s,
                           .v = start.v * c - (damping * start.v + stiffness * e) * s};
  requireFinite("position q at time t", end.q);
  requireFinite("velocity v at time t", end.v);
  return end;
}

}  // namespace rex
