#include "systems/raibert_hopper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/require.h"
#include "systems/event_integration.h"

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

// A part of stance, with the same rest length of the leg.
struct HopperPart {
  Vector6d x;  // at its begin
  double thrust = 0, time = 0;

  [[nodiscard]] internal::EventPoint<Vector6d> follow(const RaibertHopper& hopper, const RaibertGains& gains,
                                                      double end, std::span<const HopperEvent> events) const {
    return internal::integrateToEvent<Vector6d>(
        [&](const Vector6d& at) { return stanceRate(hopper, gains, at, thrust); }, x, end,
        0.1 * std::sqrt(hopper.mass / hopper.stiffness), events);
  }
};

// A hop while it goes on.
struct Hopping {
  const RaibertHopper& hopper;
  const RaibertGains& gains;
  HopperHop hop{};
  double fall = 0;  // seconds before touchdown
  std::vector<HopperPart> parts{};

  // Follows a part of stance to one of two events; none if it takes too long.
  std::optional<int> follow(Vector6d& x, double thrust, const std::array<HopperEvent, 2>& events) {
    constexpr double kLongest = 5;
    HopperPart part{.x = x, .thrust = thrust};
    const auto end = part.follow(hopper, gains, kLongest, std::span(events));
    part.time = end.t;
    parts.push_back(part);
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

HopperHop hopThrough(Hopping& now, const HopperCommand& command, const HopperApex& apex) {
  const RaibertHopper& hopper = now.hopper;
  requireHopper(hopper, now.gains);
  requireState(command, apex);
  enum : int { kNext, kFall };
  const HopperEvent ground{[](const Vector6d& x) { return x[1]; }};
  HopperHop& hop = now.hop;
  // The leg reaches no farther than it is long.
  const double most = 0.9 * hopper.restLength,
               before = std::clamp(footBeforeHip(now.gains, command, apex), -most, most);
  hop.legAngle = std::asin(before / hopper.restLength);
  const double setting = hopper.restLength * std::cos(hop.legAngle), drop = apex.height - setting;
  if (!(drop > 0)) return now.ended(HopStatus::kNoTouchdown, "the apex is too low to set the leg");
  hop.time = now.fall = std::sqrt(2 * drop / hopper.g);
  hop.foot = apex.x + apex.speed * hop.time + before;
  Vector6d x;
  x << -before, setting, apex.pitch + apex.rate * hop.time, apex.speed, -hopper.g * hop.time, apex.rate;
  hop.stance.colwise() = x;
  hop.apex = {.thrust = std::max(0., apex.thrust + now.gains.height * (command.height - apex.height)),
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

}  // namespace

HopperHop hop(const RaibertHopper& hopper, const RaibertGains& gains, const HopperCommand& command,
              const HopperApex& apex) {
  Hopping now{.hopper = hopper, .gains = gains};
  return hopThrough(now, command, apex);
}

std::vector<HopperSample> hopSamples(const RaibertHopper& hopper, const RaibertGains& gains,
                                     const HopperCommand& command, const HopperApex& apex, int count) {
  requireCount("hopper: number of samples", count, 2);
  Hopping now{.hopper = hopper, .gains = gains};
  const HopperHop all = hopThrough(now, command, apex);
  std::vector<HopperSample> samples;
  const auto flyThrough = [&](double from, double time, const Eigen::Vector2d& hip,
                              const Eigen::Vector2d& rate, double pitch, double turning, double fromAngle,
                              double toAngle) {
    for (int i = 0; i < count; ++i) {
      const double share = static_cast<double>(i) / (count - 1), t = share * time,
                   angle = fromAngle + share * (toAngle - fromAngle);
      const Eigen::Vector2d at = hip + t * rate - Eigen::Vector2d(0, hopper.g * t * t / 2);
      samples.push_back({.time = from + t,
                         .hip = at,
                         .foot = at + hopper.restLength * Eigen::Vector2d(std::sin(angle), -std::cos(angle)),
                         .pitch = pitch + t * turning});
    }
  };
  flyThrough(0, now.fall, {apex.x, apex.height}, {apex.speed, 0}, apex.pitch, apex.rate, 0, all.legAngle);
  double before = now.fall;
  for (const HopperPart& part : now.parts) {
    for (int i = 0; i < count; ++i) {
      const double t = part.time * i / (count - 1);
      const Vector6d x = part.follow(hopper, gains, t, {}).x;
      samples.push_back({.time = before + t,
                         .hip = x.head<2>() + Eigen::Vector2d(all.foot, 0),
                         .foot = {all.foot, 0},
                         .pitch = x[2]});
    }
    before += part.time;
  }
  if (all.status != HopStatus::kHopped) return samples;
  const Vector6d last = all.stance.col(2);
  flyThrough(before, all.time - before, samples.back().hip, last.segment<2>(3), last[2], last[5],
             std::atan2(-last[0], last[1]), 0);
  return samples;
}

}  // namespace rex
