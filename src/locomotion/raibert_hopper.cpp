#include "locomotion/raibert_hopper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/require.h"
#include "locomotion/event_integration_internal.h"

namespace rex {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using HopperEvent = internal::Event<Vector6d>;

void requireHopper(const RaibertHopper& hopper, const RaibertGains& gains) {
  requirePositive("hopper: mass", hopper.mass);
  requirePositive("hopper: inertia", hopper.inertia);
  requirePositive("hopper: stiffness", hopper.stiffness);
  requireNotNegative("hopper: damping", hopper.damping);
  requirePositive("hopper: rest length", hopper.restLength);
  requirePositive("hopper: g", hopper.g);
  requireNotNegative("hopper: gain of height", gains.height);
  requireNotNegative("hopper: gain of placement", gains.placement);
  requireNotNegative("hopper: gain of attitude", gains.attitude);
  requireNotNegative("hopper: gain of rate", gains.rate);
}

void requireState(const HopperCommand& command, const HopperApex& apex) {
  requirePositive("hopper: wanted height", command.height);
  requireFinite("hopper: wanted speed", command.speed);
  requireFinite("hopper: x", apex.x);
  requireFinite("hopper: height", apex.height);
  requireFinite("hopper: speed", apex.speed);
  requireFinite("hopper: pitch", apex.pitch);
  requireFinite("hopper: rate", apex.rate);
  requireFinite("hopper: thrust", apex.thrust);
  requirePositive("hopper: stance time", apex.stanceTime);
}

double legRate(const Vector6d& x) { return x.head<2>().dot(x.segment<2>(3)) / x.head<2>().norm(); }

// What the leg pushes along itself, with a rest length that is `thrust` longer.
double legPush(const RaibertHopper& hopper, const Vector6d& x, double thrust) {
  return hopper.stiffness * (hopper.restLength + thrust - x.head<2>().norm()) - hopper.damping * legRate(x);
}

// A leg without mass passes the hip's torque on to the ground: across it pushes with torque / length.
Vector6d stanceRate(const RaibertHopper& hopper, const RaibertGains& gains, const Vector6d& x,
                    double thrust) {
  const double length = x.head<2>().norm(), torque = -gains.attitude * x[2] - gains.rate * x[5];
  const Eigen::Vector2d along = x.head<2>() / length, across(-along[1], along[0]);
  const Eigen::Vector2d force = legPush(hopper, x, thrust) * along - torque / length * across;
  Vector6d d;
  d << x.tail<3>(), force / hopper.mass - Eigen::Vector2d(0, hopper.g), torque / hopper.inertia;
  return d;
}

// A hop while it goes on.
struct Hopping {
  const RaibertHopper& hopper;
  const RaibertGains& gains;
  HopperHop hop{};

  // Follows a part of stance to one of two events; none if it takes too long.
  std::optional<int> follow(Vector6d& x, double thrust, const std::array<HopperEvent, 2>& events) {
    constexpr double kLongest = 5;
    const auto end = internal::integrateToEvent<Vector6d>(
        [&](const Vector6d& y) { return stanceRate(hopper, gains, y, thrust); }, x, kLongest,
        0.1 * std::sqrt(hopper.mass / hopper.stiffness), std::span(events));
    x = end.x;
    hop.time += end.t;
    hop.apex.stanceTime += end.t;
    return end.event;
  }

  HopperHop ended(HopStatus status, const char* what) {
    hop.status = status;
    hop.message = fmt::format("{} after {:.6g} s", what, hop.time);
    return hop;
  }
};

double footBeforeHip(const RaibertGains& gains, const HopperCommand& command, const HopperApex& apex) {
  return apex.speed * apex.stanceTime / 2 + gains.placement * (apex.speed - command.speed);
}

}  // namespace

HopperHop hop(const RaibertHopper& hopper, const RaibertGains& gains, const HopperCommand& command,
              const HopperApex& apex) {
  requireHopper(hopper, gains);
  requireState(command, apex);
  enum : int { kNext, kFall };
  const HopperEvent ground{[](const Vector6d& x) { return x[1]; }};
  Hopping now{.hopper = hopper, .gains = gains};
  HopperHop& hop = now.hop;
  // The leg reaches no farther than it is long.
  const double most = 0.9 * hopper.restLength,
               before = std::clamp(footBeforeHip(gains, command, apex), -most, most);
  hop.legAngle = std::asin(before / hopper.restLength);
  const double setting = hopper.restLength * std::cos(hop.legAngle), drop = apex.height - setting;
  if (!(drop > 0)) return now.ended(HopStatus::kNoTouchdown, "the apex is too low to set the leg");
  hop.time = std::sqrt(2 * drop / hopper.g);
  hop.foot = apex.x + apex.speed * hop.time + before;
  Vector6d x;
  x << -before, setting, apex.pitch + apex.rate * hop.time, apex.speed, -hopper.g * hop.time, apex.rate;
  hop.stance.colwise() = x;
  hop.apex = {.thrust = std::max(0., apex.thrust + gains.height * (command.height - apex.height)),
              .stanceTime = 0};
  if (legRate(x) >= 0) return now.ended(HopStatus::kNoRise, "took off downwards");

  std::optional<int> event =
      now.follow(x, 0, {HopperEvent{[](const Vector6d& y) { return -legRate(y); }}, ground});
  hop.stance.rightCols<2>().colwise() = x;
  if (!event) return now.ended(HopStatus::kTimeLimit, "the leg did not stretch again");
  if (*event == kFall) return now.ended(HopStatus::kFell, "fell");

  const double thrust = hop.apex.thrust;
  event = now.follow(x, thrust,
                     {HopperEvent{[&](const Vector6d& y) { return legPush(hopper, y, thrust); }}, ground});
  hop.stance.col(2) = x;
  if (!event) return now.ended(HopStatus::kTimeLimit, "the leg did not stretch again");
  if (*event == kFall) return now.ended(HopStatus::kFell, "fell");

  const double rising = x[4] / hopper.g;
  if (!(rising > 0)) return now.ended(HopStatus::kNoRise, "took off downwards");
  hop.time += rising;
  hop.apex.x = hop.foot + x[0] + x[3] * rising;
  hop.apex.height = x[1] + x[4] * rising / 2;
  hop.apex.speed = x[3];
  hop.apex.pitch = x[2] + x[5] * rising;
  hop.apex.rate = x[5];
  return now.ended(HopStatus::kHopped, "hopped");
}

}  // namespace rex
