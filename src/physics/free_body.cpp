#include <cmath>

#include "physics/bullet_math_internal.h"
#include "physics/free_body_internal.h"

namespace rex::internal {

FreeBody::FreeBody(const Joint& joint, const BulletLink& link, const Pose& X_WP, btCollisionShape* shape)
    : motion_(joint, X_WP, link.X_BL), body_(link.mass, nullptr, shape, link.inertia), vIndex_(joint.vIndex) {
  body_.setDamping(0, 0);
  body_.setActivationState(DISABLE_DEACTIVATION);
}

void FreeBody::place(const State& state) {
  const FreeMotion::LinkMotion motion = motion_.linkMotion(state);
  set({toBullet(motion.X_WL), toBullet(motion.linear_W), toBullet(motion.angular_W)});
}

void FreeBody::set(const Raw& raw) {
  body_.clearForces();
  body_.setLinearVelocity(raw.linear);
  body_.setAngularVelocity(raw.angular);
  body_.setCenterOfMassTransform(raw.X_WL);
  body_.setInterpolationWorldTransform(raw.X_WL);
  body_.setInterpolationLinearVelocity(raw.linear);
  body_.setInterpolationAngularVelocity(raw.angular);
}

FreeMotion::LinkMotion FreeBody::current() const {
  return {fromBullet(body_.getCenterOfMassTransform()), fromBullet(body_.getLinearVelocity()),
          fromBullet(body_.getAngularVelocity())};
}

void FreeBody::drive(std::span<const Motor> motors, double) {
  if (motion_.isIdle(motors)) return;
  const FreeMotion::Wrench wrench = motion_.wrench(motors, current());
  body_.applyCentralForce(toBullet(wrench.force_W));
  body_.applyTorque(toBullet(wrench.torque_W));
}

void FreeBody::remember() {
  remembered_ = {body_.getCenterOfMassTransform(), body_.getLinearVelocity(), body_.getAngularVelocity()};
}

int FreeBody::runaway(double limit) const {
  const btVector3 &linear = body_.getLinearVelocity(), &angular = body_.getAngularVelocity();
  if (linear.length2() < limit * limit && angular.length2() < limit * limit) return -1;
  return vIndex_;
}

}  // namespace rex::internal
