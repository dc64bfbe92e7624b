#pragma once

namespace rex {

/// How a motion speeds up and slows down (slides 2:39 and 2:40): MP(s) goes from 0 to 1 while s, the
/// fraction of the time that has passed, goes from 0 to 1.
enum class ProfileShape {
  kRamp,        ///< s: constant velocity, which jumps at both ends
  kSine,        ///< (1 - cos(pi s)) / 2: velocity at most pi/2, acceleration at most pi^2/2
  kTrapezoid,   ///< constant acceleration for the time `blend`, constant velocity, constant deceleration
  kMinimumJerk  ///< 10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan 1985): no jump of velocity or acceleration
};

struct MotionProfile {
  ProfileShape shape = ProfileShape::kSine;
  double blend = 0.25;  ///< fraction of the time, in (0, 0.5], in which a trapezoid reaches its velocity
};

/// Derivatives are with respect to s. For a distance x in time T, multiply velocities by x / T and
/// accelerations by x / T^2.
struct ProfilePoint {
  double position = 0, velocity = 0, acceleration = 0;
};

/// The profile at s. Before 0 and after 1 it rests at 0 and 1. At a corner, the derivative is the one-sided
/// derivative from the right, and at s = 1 that from the left. Throws Error for a blend outside (0, 0.5]
/// and for numbers that are not finite.
[[nodiscard]] ProfilePoint profileAt(const MotionProfile& profile, double s);

}  // namespace rex
