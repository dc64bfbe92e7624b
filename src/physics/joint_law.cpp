#include <algorithm>
#include <cmath>

#include "physics/joint_law_internal.h"

namespace rex::internal {
namespace {

// A position motor approaches its target at this rate, 1/s: slowly enough for arms to brake.
constexpr double kPositionRate = 20;
// Joints beyond a limit come back at this rate, 1/s, and at most this fast, rad/s or m/s: they keep that
// speed when they are back, so a higher one would throw a robot that starts beyond its limits.
constexpr double kLimitRate = 20, kLimitSpeed = 1;

}  // namespace

JointLaw jointLaw(const Model& model, const Joint& joint, int coordinate, const PhysicsOptions& options) {
  JointLaw law{.maxVelocity = joint.maxVelocity};
  if (options.jointFriction) {
    law.damping = joint.damping;
    law.friction = joint.friction;
  }
  if (options.jointLimits && joint.nq == joint.nv) {
    law.lower = model.lowerLimits()[joint.qIndex + coordinate];
    law.upper = model.upperLimits()[joint.qIndex + coordinate];
  }
  return law;
}

JointGoals jointGoals(const JointLaw& law, const Motor& motor, double q, double v, double h) {
  JointGoals goals;
  if (motor.kind != Motor::Kind::kForce) {
    const double rate = std::min(kPositionRate, 1 / h);
    const double wanted = motor.kind == Motor::Kind::kVelocity ? motor.target : rate * (motor.target - q);
    goals[kMotor] = {std::clamp(wanted, -law.maxVelocity, law.maxVelocity), -motor.maxForce * h,
                     motor.maxForce * h};
  }
  if (law.damping > 0) goals[kDamping] = {0, -kInfinity, kInfinity, 1 / (law.damping * h)};
  if (law.friction > 0) goals[kFriction] = {0, -law.friction * h, law.friction * h};
  const double reach = kLimitReach + 2 * h * std::abs(v);
  const auto backOff = [&](double beyond) {
    return beyond > 0 ? std::min(kLimitRate * beyond, kLimitSpeed) : beyond / h;
  };
  if (law.lower - q > -reach) goals[kLowerLimit] = {backOff(law.lower - q), 0, kInfinity};
  if (q - law.upper > -reach) goals[kUpperLimit] = {-backOff(q - law.upper), -kInfinity, 0};
  return goals;
}

}  // namespace rex::internal
