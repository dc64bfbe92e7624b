#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "physics/bullet_shape_internal.h"
#include "physics/simulated_tree_internal.h"

namespace rex::internal {

BulletLink bulletLink(const Body& body) {
  const Eigen::Matrix3d& I = body.I_BBcm_B;
  if (I.isDiagonal(0)) return {{Eigen::Matrix3d::Identity(), body.p_BBcm}, body.mass, toBullet(I.diagonal())};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(I);
  Eigen::Matrix3d R = axes.eigenvectors();
  if (R.determinant() < 0) R.col(0) = -R.col(0);
  return {{R, body.p_BBcm}, body.mass, toBullet(axes.eigenvalues())};
}

FreeMotion::FreeMotion(const Joint& joint, const Pose& X_WP, const Pose& X_BL)
    : qIndex_(joint.qIndex),
      vIndex_(joint.vIndex),
      X_WF_(X_WP * joint.X_PF),
      X_ML_(joint.X_MC * X_BL),
      X_LM_(X_ML_.inverse()) {}

FreeMotion::LinkMotion FreeMotion::linkMotion(const State& state) const {
  const Pose X_FM{rotationFromQuaternion(state.q.segment<4>(qIndex_ + 3)), state.q.segment<3>(qIndex_)};
  const Pose X_WM = X_WF_ * X_FM;
  const Eigen::Vector3d angular_W = X_WM.R * state.v.segment<3>(vIndex_ + 3);
  const Eigen::Vector3d linear_W = X_WF_.R * state.v.segment<3>(vIndex_);
  return {X_WM * X_ML_, linear_W + angular_W.cross(X_WM.R * X_ML_.p), angular_W};
}

void FreeMotion::read(const LinkMotion& motion, State& state) const {
  const Pose X_WM = motion.X_WL * X_LM_;
  const Pose X_FM = X_WF_.inverse() * X_WM;
  state.q.segment<3>(qIndex_) = X_FM.p;
  state.q.segment<4>(qIndex_ + 3) = quaternionFromRotation(X_FM.R);
  const Eigen::Vector3d linear_W = motion.linear_W - motion.angular_W.cross(X_WM.R * X_ML_.p);
  state.v.segment<3>(vIndex_) = X_WF_.R.transpose() * linear_W;
  state.v.segment<3>(vIndex_ + 3) = X_WM.R.transpose() * motion.angular_W;
}

bool FreeMotion::isIdle(std::span<const Motor> motors) const {
  const auto mine = motors.subspan(static_cast<std::size_t>(vIndex_), 6);
  return std::all_of(mine.begin(), mine.end(), [](const Motor& one) { return one.target == 0; });
}

FreeMotion::Wrench FreeMotion::wrench(std::span<const Motor> motors, const LinkMotion& motion) const {
  Eigen::Vector3d force, torque;
  for (int i = 0; i < 3; ++i) {
    force[i] = motors[static_cast<std::size_t>(vIndex_ + i)].target;
    torque[i] = motors[static_cast<std::size_t>(vIndex_ + 3 + i)].target;
  }
  const Eigen::Vector3d force_W = X_WF_.R * force;
  return {force_W, motion.X_WL.R * (X_LM_.R * torque) + p_LM_W(motion).cross(force_W)};
}

FreeBody::FreeBody(const Joint& joint, const BulletLink& link, const Pose& X_WP, btCollisionShape* shape,
                   const Eigen::Vector3d& lift_W)
    : motion_(joint, X_WP, link.X_BL),
      body_(link.mass, nullptr, shape, link.inertia),
      vIndex_(joint.vIndex),
      lift_(toBullet(lift_W)) {
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
  body_.applyCentralForce(lift_);
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
