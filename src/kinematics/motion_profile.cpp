#include "kinematics/motion_profile.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

ProfilePoint sine(double s) {
  constexpr double kPi = std::numbers::pi;
  const double half = std::sin(kPi * s / 2);  // its square is exact even where 1 - cos is not
  return {half * half, kPi / 2 * std::sin(kPi * s), kPi * kPi / 2 * std::cos(kPi * s)};
}

// The second half is the first, mirrored in time and position.
ProfilePoint trapezoid(double s, double blend) {
  const double velocity = 1 / (1 - blend), acceleration = velocity / blend;
  if (s < blend) return {acceleration * s * s / 2, acceleration * s, acceleration};
  if (s < 1 - blend) return {velocity * (s - blend / 2), velocity, 0};
  const double left = 1 - s;
  return {1 - acceleration * left * left / 2, acceleration * left, -acceleration};
}

ProfilePoint minimumJerk(double s) {
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s),
          60 * s * (1 - s) * (1 - 2 * s)};
}

void requireProfile(const MotionProfile& profile, double s) {
  requireFinite("time of a motion profile", s);
  if (profile.shape == ProfileShape::kTrapezoid && !(profile.blend > 0 && profile.blend <= 0.5)) {
    throw Error({.what = "blend of a trapezoid profile",
                 .found = fmt::format("{}", profile.blend),
                 .wanted = "a number in (0, 0.5]"});
  }
}

}  // namespace

ProfilePoint profileAt(const MotionProfile& profile, double s) {
  requireProfile(profile, s);
  if (s < 0) return {};
  if (s > 1) return {.position = 1};
  switch (profile.shape) {
    case ProfileShape::kRamp:
      return {s, 1, 0};
    case ProfileShape::kSine:
      return sine(s);
    case ProfileShape::kTrapezoid:
      return trapezoid(s, profile.blend);
    case ProfileShape::kMinimumJerk:
      break;
  }
  return minimumJerk(s);
}

}  // namespace rex
