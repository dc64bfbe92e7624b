#include "locomotion/rimless_wheel.h"

#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

void requireWheel(const RimlessWheel& wheel) {
  if (wheel.spokes < 5)
    throw Error({.what = "rimless wheel: spokes",
                 .found = fmt::format("{}", wheel.spokes),
                 .wanted = "at least 5: with fewer, an impact stops it"});
  requirePositive("rimless wheel: length l", wheel.l);
  requirePositive("rimless wheel: g", wheel.g);
  if (!(wheel.slope >= 0 && wheel.slope < std::numbers::pi / 2))
    throw Error({.what = "rimless wheel: slope",
                 .found = fmt::format("{:g}", wheel.slope),
                 .wanted = "an angle in [0, pi/2)"});
}

// By how much omega^2 falls on the way from `angle` up to the vertical.
double climb(const RimlessWheel& wheel, double angle) {
  return 2 * wheel.g / wheel.l * (1 - std::cos(angle));
}

// Whether the spoke presses on the ground at this angle and squared rate.
bool presses(const RimlessWheel& wheel, double angle, double squaredRate) {
  return wheel.g * std::cos(angle) >= wheel.l * squaredRate;
}

}  // namespace

double RimlessWheel::alpha() const {
  requireWheel(*this);
  return std::numbers::pi / spokes;
}

double RimlessWheel::leastRate() const {
  const double start = slope - alpha();
  return start >= 0 ? 0 : std::sqrt(climb(*this, start));
}

RimlessWheel::Step RimlessWheel::step(double rate) const {
  requireWheel(*this);
  requireFinite("rimless wheel: rate", rate);
  using Status = Step::Status;
  // The spoke leans uphill by alpha - slope where it touches down, and leaves alpha + slope further down.
  const double start = slope - alpha(), end = slope + alpha(), keeps = std::cos(2 * alpha());
  const double squared = rate * rate;
  const auto lost = [&](double angle) {
    return Step{Status::kLostContact, rate,
                fmt::format("the spoke leaves the ground at {:.6g} rad from the vertical", angle)};
  };
  if (rate >= 0 && (rate > leastRate() || start >= 0)) {
    const double atEnd = squared + 4 * g / l * std::sin(alpha()) * std::sin(slope);
    if (!presses(*this, start, squared)) return lost(start);
    if (!presses(*this, end, atEnd)) return lost(end);
    return {Status::kRolled, keeps * std::sqrt(atEnd), "rolls on"};
  }
  if (rate >= 0) {
    if (!presses(*this, start, squared)) return lost(start);
    return {
        Status::kRockedBack, -keeps * rate,
        fmt::format("rate {:.6g} does not carry it over the spoke: {:.6g} rad/s would", rate, leastRate())};
  }
  // A backward step starts where a forward one ends.
  if (!presses(*this, end, squared)) return lost(end);
  const double left = squared - climb(*this, end);
  const double atStart = left + climb(*this, start);
  // The hardest point of the way is the vertical, or the start if that comes first.
  if ((start < 0 ? left : atStart) <= 0) return {Status::kRockedBack, keeps * -rate, "rocks back downhill"};
  if (!presses(*this, start, atStart)) return lost(start);
  return {Status::kRolledUphill, -keeps * std::sqrt(atStart), "rolls uphill"};
}

std::optional<RimlessWheel::FixedPoint> RimlessWheel::fixedPoint() const {
  requireWheel(*this);
  const double keeps = std::cos(2 * alpha()), loses = std::sin(2 * alpha());
  const double rate = keeps / loses * std::sqrt(4 * g / l * std::sin(alpha()) * std::sin(slope));
  if (slope == 0 || step(rate).status != Step::Status::kRolled) return std::nullopt;
  return FixedPoint{.rate = rate, .multiplier = keeps * keeps};
}

}  // namespace rex
