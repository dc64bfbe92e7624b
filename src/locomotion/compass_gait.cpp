#include "locomotion/compass_gait.h"

#include <array>
#include <numbers>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "systems/event_integration.h"

namespace rex {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using StateAndJacobian = Eigen::Matrix<double, 20, 1>;  // a state, and columns of its derivative by the start

void requireWalker(const CompassGait& walker) {
  requireNotNegative("compass gait: length a", walker.a);
  requirePositive("compass gait: length b", walker.b);
  requireNotNegative("compass gait: mass of a leg", walker.legMass);
  requirePositive("compass gait: mass of the hip", walker.hipMass);
  requirePositive("compass gait: g", walker.g);
  if (!(std::abs(walker.slope) < 1))
    throw Error({.what = "compass gait: slope",
                 .found = fmt::format("{:g}", walker.slope),
                 .wanted = "an angle in (-1, 1)"});
}

void requireState(const CompassGait& walker, const Vector4d& x) {
  requireWalker(walker);
  requireFinite("compass gait: state", x);
}

// The constants of the equations. Those of the swing leg are divided by its mass, which may then vanish.
struct Constants {
  double l, lift, weight;  // lift: (mH + m) l^2 + m a^2, weight: g ((mH + m) l + m a)

  explicit Constants(const CompassGait& w)
      : l(w.a + w.b),
        lift((w.hipMass + w.legMass) * l * l + w.legMass * w.a * w.a),
        weight(w.g * ((w.hipMass + w.legMass) * l + w.legMass * w.a)) {}
};

// M (theta_s'', theta_ns'') = r.
struct Equations {
  Matrix2d M;
  Vector2d r;
};

Equations equations(const CompassGait& w, const Vector4d& x) {
  const Constants k(w);
  const double c = std::cos(x[0] - x[1]), s = std::sin(x[0] - x[1]), coupling = k.l * w.b;
  Equations e;
  e.M << k.lift, -w.legMass * coupling * c, -coupling * c, w.b * w.b;
  e.r << w.legMass * coupling * s * x[3] * x[3] + k.weight * std::sin(x[0]),
      -coupling * s * x[2] * x[2] - w.g * w.b * std::sin(x[1]);
  return e;
}

Matrix2d inverted(const Matrix2d& M) { return M.inverse(); }

Vector4d rate(const CompassGait& w, const Vector4d& x) {
  const Equations e = equations(w, x);
  Vector4d d;
  d << x.tail<2>(), inverted(e.M) * e.r;
  return d;
}

Matrix4d rateJacobian(const CompassGait& w, const Vector4d& x) {
  const Constants k(w);
  const Equations e = equations(w, x);
  const Matrix2d inverse = inverted(e.M);
  const Vector2d turn = inverse * e.r;
  const double c = std::cos(x[0] - x[1]), s = std::sin(x[0] - x[1]), coupling = k.l * w.b;
  // The derivative by the angle between the legs; then by each angle and by each rate.
  const Vector2d byDifference(w.legMass * coupling * (c * x[3] * x[3] - s * turn[1]),
                              -coupling * (c * x[2] * x[2] + s * turn[0]));
  Matrix4d J = Matrix4d::Zero();
  J.topRightCorner<2, 2>().setIdentity();
  J.col(0).tail<2>() = inverse * (byDifference + Vector2d(k.weight * std::cos(x[0]), 0));
  J.col(1).tail<2>() = inverse * (-byDifference - Vector2d(0, w.g * w.b * std::cos(x[1])));
  J.col(2).tail<2>() = inverse * Vector2d(0, -2 * coupling * s * x[2]);
  J.col(3).tail<2>() = inverse * Vector2d(2 * w.legMass * coupling * s * x[3], 0);
  return J;
}

// Angular momenta about the foot that comes down, and of the rear leg about the hip (per unit of its mass),
// from the rates before and after the impact. The angle between the legs is the only one that matters.
struct Momenta {
  Matrix2d before, after;
};

Momenta momenta(const CompassGait& w, double c) {
  const Constants k(w);
  const double m = w.legMass, coupling = k.l * w.b;
  Momenta momenta;
  momenta.before << (w.hipMass * k.l * k.l + 2 * m * w.a * k.l) * c - m * w.a * w.b, -m * w.a * w.b,
      -w.a * w.b, 0;
  momenta.after << k.lift - m * coupling * c, m * (w.b * w.b - coupling * c), -coupling * c, w.b * w.b;
  return momenta;
}

Vector4d impactOf(const CompassGait& w, const Vector4d& x) {
  const Momenta L = momenta(w, std::cos(x[0] - x[1]));
  Vector4d after;
  after << x[1], x[0], inverted(L.after) * (L.before * x.tail<2>());
  return after;
}

Matrix4d impactJacobianOf(const CompassGait& w, const Vector4d& x) {
  const Momenta L = momenta(w, std::cos(x[0] - x[1]));
  const Momenta rest = momenta(w, 0);
  const Matrix2d inverse = inverted(L.after);
  const Vector2d rates = inverse * (L.before * x.tail<2>());
  // Both matrices are linear in the cosine.
  const Momenta slopes = momenta(w, 1);
  const Vector2d byCosine =
      inverse * ((slopes.before - rest.before) * x.tail<2>() - (slopes.after - rest.after) * rates);
  Matrix4d J = Matrix4d::Zero();
  J(0, 1) = J(1, 0) = 1;
  J.col(0).tail<2>() = -std::sin(x[0] - x[1]) * byCosine;
  J.col(1).tail<2>() = std::sin(x[0] - x[1]) * byCosine;
  J.bottomRightCorner<2, 2>() = inverse * L.before;
  return J;
}

// The direction up along a leg at this angle, and its derivative by the angle.
Vector2d along(double angle) { return {-std::sin(angle), std::cos(angle)}; }
Vector2d across(double angle) { return {-std::cos(angle), -std::sin(angle)}; }

Vector2d groundForceOf(const CompassGait& w, const Vector4d& x) {
  const Vector2d turn = rate(w, x).tail<2>(), gravity(0, -w.g);
  const Vector2d stance = turn[0] * across(x[0]) - x[2] * x[2] * along(x[0]);
  const Vector2d swing = turn[1] * across(x[1]) - x[3] * x[3] * along(x[1]);
  const double l = w.a + w.b;
  const Vector2d force = w.hipMass * (l * stance - gravity) + w.legMass * (w.a * stance - gravity) +
                         w.legMass * (l * stance - w.b * swing - gravity);
  const double c = std::cos(w.slope), s = std::sin(w.slope);
  return {c * force.x() - s * force.y(), s * force.x() + c * force.y()};
}

// How fast the rear foot leaves the ground just after an impact.
double liftingRate(const Vector4d& x) { return -(x[2] + x[3]); }

enum Ending : int { kTouchdown, kForward, kBackward };

template <class Vector>
std::array<internal::Event<Vector>, 3> endings(const CompassGait& w) {
  const double up = std::numbers::pi / 2 + w.slope;
  return {{{[w](const Vector& x) { return x[0] + x[1] + 2 * w.slope; },
            [](const Vector& x) { return x[1] > x[0]; }},
           {[up](const Vector& x) { return up + x[0]; }},
           {[up, w](const Vector& x) { return up - 2 * w.slope - x[0]; }}}};
}

StepStatus statusOf(const std::optional<int>& event) {
  if (!event) return StepStatus::kTimeLimit;
  if (*event == kTouchdown) return StepStatus::kStepped;
  return *event == kForward ? StepStatus::kFellForward : StepStatus::kFellBackward;
}

std::string messageOf(StepStatus status, double time) {
  constexpr std::array kWhat = {"stepped", "fell forward", "fell backward", "the rear foot did not lift",
                                "no foot came down"};
  return fmt::format("{} after {:.6g} s", kWhat[static_cast<std::size_t>(status)], time);
}

// What ends a step before it has begun.
std::optional<StepStatus> hindered(const CompassGait& w, const Vector4d& x) {
  const double lean = x[0] + w.slope, sum = x[0] + x[1] + 2 * w.slope;
  if (lean <= -std::numbers::pi / 2) return StepStatus::kFellForward;
  if (lean >= std::numbers::pi / 2) return StepStatus::kFellBackward;
  if (x[0] >= x[1] && sum > -1e-12 && liftingRate(x) <= 0) return StepStatus::kFootStuck;
  return std::nullopt;
}

// Follows a state, with or without its derivative below it, to the end of the step.
template <class Vector, class F>
WalkerStep stepOf(const CompassGait& w, const F& f, Vector& x, double timeLimit) {
  requireState(w, x.template head<4>());
  requirePositive("compass gait: time limit", timeLimit);
  WalkerStep step{.before = x.template head<4>()};
  if (const std::optional<StepStatus> status = hindered(w, step.before)) {
    step.status = *status;
  } else {
    // Short compared to the time in which a leg falls, so that no event comes and goes unseen.
    const double longest = 0.1 * std::sqrt((w.a + w.b) / w.g);
    const auto events = endings<Vector>(w);
    const auto end = internal::integrateToEvent<Vector>(f, x, timeLimit, longest, std::span(events));
    x = end.x;
    step.status = statusOf(end.event);
    step.time = end.t;
    step.before = x.template head<4>();
  }
  if (step.status == StepStatus::kStepped) step.after = impactOf(w, step.before);
  step.message = messageOf(step.status, step.time);
  return step;
}

}  // namespace

Vector4d CompassGait::derivative(const Vector4d& x) const {
  requireState(*this, x);
  return rate(*this, x);
}

Matrix4d CompassGait::derivativeJacobian(const Vector4d& x) const {
  requireState(*this, x);
  return rateJacobian(*this, x);
}

double CompassGait::energy(const Vector4d& x) const {
  requireState(*this, x);
  const Constants k(*this);
  const double kinetic = k.lift * x[2] * x[2] / 2 + legMass * b * b * x[3] * x[3] / 2 -
                         legMass * k.l * b * std::cos(x[0] - x[1]) * x[2] * x[3];
  return kinetic + k.weight * std::cos(x[0]) - legMass * g * b * std::cos(x[1]);
}

Vector2d CompassGait::groundForce(const Vector4d& x) const {
  requireState(*this, x);
  return groundForceOf(*this, x);
}

Vector4d CompassGait::impact(const Vector4d& x) const {
  requireState(*this, x);
  return impactOf(*this, x);
}

Matrix4d CompassGait::impactJacobian(const Vector4d& x) const {
  requireState(*this, x);
  return impactJacobianOf(*this, x);
}

WalkerStep CompassGait::step(const Vector4d& x, double timeLimit) const {
  Vector4d at = x;
  return stepOf(
      *this, [this](const Vector4d& y) { return rate(*this, y); }, at, timeLimit);
}

WalkerStepJacobian CompassGait::stepJacobian(const Vector4d& x, double timeLimit) const {
  StateAndJacobian at;
  at << x, Matrix4d::Identity().reshaped();
  const auto variation = [this](const StateAndJacobian& y) {
    StateAndJacobian d;
    d << rate(*this, y.head<4>()),
        (rateJacobian(*this, y.head<4>()) * y.tail<16>().reshaped(4, 4)).reshaped();
    return d;
  };
  WalkerStepJacobian result{.step = stepOf(*this, variation, at, timeLimit)};
  if (result.step.status != StepStatus::kStepped) return result;
  const Matrix4d flow = at.tail<16>().reshaped(4, 4);
  const Vector4d slopeHere = rate(*this, result.step.before);
  // The sum of both angles is the same at all impacts: the time of impact moves with the start.
  const Eigen::RowVector4d time = -(flow.row(0) + flow.row(1)) / (slopeHere[0] + slopeHere[1]);
  result.J = impactJacobianOf(*this, result.step.before) * (flow + slopeHere * time);
  return result;
}

CompassGait simplestWalker(double slope) {
  return {.a = 0, .b = 1, .legMass = 0, .hipMass = 1, .slope = slope, .g = 1};
}

}  // namespace rex
