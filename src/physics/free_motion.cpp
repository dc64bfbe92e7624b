#include <algorithm>

#include <Eigen/Geometry>

#include "geometry/rotation.h"
#include "physics/free_motion_internal.h"

namespace rex::internal {

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

}  // namespace rex::internal
