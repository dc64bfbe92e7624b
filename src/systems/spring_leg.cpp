#include "systems/spring_leg.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "systems/event_integration.h"

namespace rex {
namespace {

using Eigen::Vector4d;

void requireLeg(const SpringLeg& leg) {
  requirePositive("spring leg: mass", leg.mass);
  requirePositive("spring leg: stiffness", leg.stiffness);
  requirePositive("spring leg: rest length", leg.restLength);
  requirePositive("spring leg: g", leg.g);
  if (!(leg.angle > 0 && leg.angle < std::numbers::pi / 2))
    throw Error({.what = "spring leg: angle",
                 .found = fmt::format("{:g}", leg.angle),
                 .wanted = "an angle in (0, pi/2)"});
}

void requireApex(const SpringLeg& leg, const RunnerApex& apex) {
  requireLeg(leg);
  requireFinite("spring leg: height of the apex", apex.height);
  requireFinite("spring leg: speed of the apex", apex.speed);
}

Vector4d stanceRate(const SpringLeg& leg, const Vector4d& x) {
  const double length = x.head<2>().norm();
  const double push = leg.stiffness * (leg.restLength - length) / (leg.mass * length);
  Vector4d d;
  d << x.tail<2>(), push * x[0], push * x[1] - leg.g;
  return d;
}

// How fast the leg gets longer, times its length.
double stretching(const Vector4d& x) { return x.head<2>().dot(x.tail<2>()); }

enum FlightEnding : int { kStretched, kGround };

// The leg is at its rest length at touchdown, too, while it is still getting shorter.
std::array<internal::Event<Vector4d>, 2> endings(const SpringLeg& leg) {
  return {
      {{[l = leg.restLength](const Vector4d& x) { return std::max(l - x.head<2>().norm(), -stretching(x)); }},
       {[](const Vector4d& x) { return x[1]; }}}};
}

Hop ended(Hop hop, HopStatus status, const char* what) {
  hop.status = status;
  hop.message = fmt::format("{} after {:.6g} s", what, hop.time);
  return hop;
}

// The apexes of one energy, where the runner moves one way: the height alone tells them apart.
struct ApexFamily {
  double energy, direction;  // joules; 1 or -1

  ApexFamily(const SpringLeg& leg, const RunnerApex& apex)
      : energy(leg.apexEnergy(apex)), direction(std::copysign(1., apex.speed)) {}

  [[nodiscard]] RunnerApex at(const SpringLeg& leg, double height) const {
    return {height, direction * std::sqrt(std::max(2 * (energy / leg.mass - leg.g * height), 0.))};
  }
};

// An apex of a family, and how a hop changes its height.
struct ApexTrial {
  RunnerApex apex;
  double rise = 0, multiplier = 0;
  std::optional<std::string> failure{};

  ApexTrial(const SpringLeg& leg, const ApexFamily& family, double height) : apex(family.at(leg, height)) {
    constexpr double kDifference = 1e-5;
    std::array<double, 3> heights{};
    for (int i = 0; i < 3; ++i) {
      const RunnerApex start = family.at(leg, height + (i - 1) * kDifference);
      const Hop hop = leg.hop(start);
      if (hop.status != HopStatus::kHopped)
        failure = hop.message;
      else if (hop.apex.speed * start.speed < 0)
        failure = fmt::format("turned back, from {:.6g} to {:.6g} m/s", start.speed, hop.apex.speed);
      heights[static_cast<std::size_t>(i)] = hop.apex.height;
    }
    rise = heights[1] - height;
    multiplier = (heights[2] - heights[0]) / (2 * kDifference);
  }
};

// Halves Newton's step until the runner can hop from there and the residual falls.
bool advance(const SpringLeg& leg, const ApexFamily& family, ApexTrial& at) {
  const double way = at.rise / (1 - at.multiplier);
  for (double share = 1; share > 1e-4; share /= 2) {
    const ApexTrial next(leg, family, at.apex.height + share * way);
    if (next.failure || !(std::abs(next.rise) < std::abs(at.rise))) continue;
    at = next;
    return true;
  }
  return false;
}

}  // namespace

Vector4d SpringLeg::stanceDerivative(const Vector4d& x) const {
  requireLeg(*this);
  requireFinite("spring leg: state", x);
  return stanceRate(*this, x);
}

double SpringLeg::stanceEnergy(const Vector4d& x) const {
  requireLeg(*this);
  requireFinite("spring leg: state", x);
  const double compression = restLength - x.head<2>().norm();
  return mass * (x.tail<2>().squaredNorm() / 2 + g * x[1]) + stiffness * compression * compression / 2;
}

double SpringLeg::apexEnergy(const RunnerApex& apex) const {
  requireApex(*this, apex);
  return mass * (apex.speed * apex.speed / 2 + g * apex.height);
}

Hop SpringLeg::hop(const RunnerApex& apex, double timeLimit) const {
  requireApex(*this, apex);
  requirePositive("spring leg: time limit", timeLimit);
  const double drop = apex.height - restLength * std::sin(angle);
  Hop hop;
  if (!(drop > 0)) return ended(hop, HopStatus::kNoTouchdown, "the apex is too low to set the leg");
  hop.time = std::sqrt(2 * drop / g);
  hop.touchdown << -restLength * std::cos(angle), restLength * std::sin(angle), apex.speed, -g * hop.time;
  hop.takeoff = hop.touchdown;
  if (stretching(hop.touchdown) >= 0) return ended(hop, HopStatus::kNoRise, "took off downwards");
  const auto events = endings(*this);
  const auto end = internal::integrateToEvent<Vector4d>(
      [this](const Vector4d& x) { return stanceRate(*this, x); }, hop.touchdown, timeLimit,
      0.1 * std::sqrt(mass / stiffness), std::span(events));
  hop.stanceTime = end.t;
  hop.time += end.t;
  hop.takeoff = end.x;
  if (!end.event) return ended(hop, HopStatus::kTimeLimit, "the leg did not stretch again");
  if (*end.event == kGround) return ended(hop, HopStatus::kFell, "fell");
  const double rise = end.x[3];
  if (!(rise > 0)) return ended(hop, HopStatus::kNoRise, "took off downwards");
  hop.time += rise / g;
  hop.apex = {.height = end.x[1] + rise * rise / (2 * g), .speed = end.x[2]};
  return ended(hop, HopStatus::kHopped, "hopped");
}

RunningGait findRunningGait(const SpringLeg& leg, const RunnerApex& guess) {
  constexpr int kMostIterations = 50;
  const ApexFamily family(leg, guess);
  ApexTrial at(leg, family, guess.height);
  RunningGait gait;
  gait.message = fmt::format("not found in {} iterations", kMostIterations);
  for (; gait.iterations < kMostIterations; ++gait.iterations) {
    if (at.failure || std::abs(at.rise) <= 1e-13 * leg.restLength) break;
    if (!advance(leg, family, at)) break;
  }
  gait.apex = at.apex;
  gait.multiplier = at.multiplier;
  gait.residual = std::abs(at.rise);
  if (at.failure) {
    gait.status = RunningGait::Status::kFell;
    gait.message = fmt::format("from the apex {:.6g} m: {}", at.apex.height, *at.failure);
  } else if (gait.residual <= 1e-13 * leg.restLength) {
    gait.status = RunningGait::Status::kFound;
    gait.isStable = std::abs(gait.multiplier) < 1;
    gait.message =
        fmt::format("found: {}, multiplier {:.6g}", gait.isStable ? "stable" : "unstable", gait.multiplier);
  } else if (gait.iterations < kMostIterations) {
    gait.status = RunningGait::Status::kStuck;
    gait.message = fmt::format("stuck: a hop changes the height by {:.3g} m", gait.residual);
  }
  return gait;
}

}  // namespace rex
