#include "physics/free_motion_internal.h"

#include <Eigen/Geometry>

#include "geometry/rotation.h"

namespace rex::internal {

FreeMotion::FreeMotion(const Joint& joint, const Pose& X_WP, const Pose& X_BL, const PhysicsOptions& options)
    : qIndex_(joint.qIndex),
      vIndex_(joint.vIndex),
      damping_(options.jointFriction ? joint.damping : 0),
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

FreeMotion::Wrench FreeMotion::wrench(std::span<const Motor> motors, const LinkMotion& motion) const {
  Eigen::Vector3d force, torque;
  for (int i = 0; i < 3; ++i) {
    force[i] = motors[static_cast<std::size_t>(vIndex_ + i)].target;
    torque[i] = motors[static_cast<std::size_t>(vIndex_ + 3 + i)].target;
  }
  const Eigen::Matrix3d R_WM = motion.X_WL.R * X_LM_.R;
  const Eigen::Vector3d p_LM_W = motion.X_WL.R * X_LM_.p;
  const Eigen::Vector3d linear_W = motion.linear_W + motion.angular_W.cross(p_LM_W);
  const Eigen::Vector3d force_W = X_WF_.R * force - damping_ * linear_W;
  return {force_W, R_WM * torque - damping_ * motion.angular_W + p_LM_W.cross(force_W)};
}

}  // namespace rex::internal
