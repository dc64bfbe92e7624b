#pragma once

#include <array>
#include <limits>
#include <optional>

#include "physics/physics_world.h"

namespace rex::internal {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Limits become active within this distance, radians or metres, or within twice the motion of a step.
inline constexpr double kLimitReach = 0.01;

/// What bounds or resists the motion of one coordinate.
struct JointLaw {
  double lower = -kInfinity, upper = kInfinity;
  double damping = 0, friction = 0, maxVelocity = kInfinity;
};

/// The law of entry `coordinate` of a joint's v; balls have no limits.
[[nodiscard]] JointLaw jointLaw(const Model& model, const Joint& joint, int coordinate,
                                const PhysicsOptions& options);

/// Wants a velocity of a coordinate to be `velocity`, with impulses within bounds. It yields by `softness`
/// times the impulse.
struct JointGoal {
  double velocity = 0;
  double lowest = 0, highest = 0;  ///< impulse: N s, or N m s
  double softness = 0;
};

enum JointPurpose { kMotor, kDamping, kFriction, kLowerLimit, kUpperLimit, kJointPurposes };
using JointGoals = std::array<std::optional<JointGoal>, kJointPurposes>;

/// What a coordinate at q that moves with v is to do in a step of h seconds.
[[nodiscard]] JointGoals jointGoals(const JointLaw& law, const Motor& motor, double q, double v, double h);

}  // namespace rex::internal
