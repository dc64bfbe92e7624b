#pragma once

namespace rex {

/// How a motion speeds up and slows down (slides 2:39 and 2:40): s -> MP(s) from 0 to 1 while s, the share of
/// the time that has passed, goes from 0 to 1.
enum class ProfileShape {
  kRamp,        ///< s: constant velocity, which jumps at both ends
  kSine,        ///< (1 - cos(pi s)) / 2: velocity at most pi/2, acceleration at most pi^2/2
  kTrapezoid,   ///< constant acceleration for the time `blend`, constant velocity, constant deceleration
  kMinimumJerk  ///< 10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan 1985): no jump of velocity or acceleration
};

struct MotionProfile {
  ProfileShape shape = ProfileShape::kSine;
  double blend = 0.25;  ///< share of the time, in (0, 0.5], that a trapezoid takes to reach its velocity
};

/// Derivatives are by s: over a way x in time T, velocities are x / T and accelerations x / T^2 times these.
struct ProfilePoint {
  double position = 0, velocity = 0, acceleration = 0;
};

/// The profile at s. Before 0 and after 1 it rests at 0 and 1; where it has a corner, the derivative is that
/// of the side with the larger s, at 1 that of the other. Throws Error for a blend outside (0, 0.5] and a
/// number that is not finite.
[[nodiscard]] ProfilePoint profileAt(const MotionProfile& profile, double s);

}  // namespace rex
