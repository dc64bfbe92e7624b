#include "kinematics/forward_kinematics.h"

#include "base/cpu_lanes.h"
#include "geometry/rotation.h"
#include "kinematics/pose_batch_internal.h"

namespace rex {

void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out) {
  static_assert(sizeof(Pose) == MotionStep::kPoseSize * sizeof(double));
  requireSize("joint positions q", q.size(), model.nq());
  if (internal::hasQuaternions(model)) internal::requireQuaternions(model, q.data());
  out.X_WB.resize(model.bodies().size());
  out.X_WB.front() = Pose{};
  const std::span<const MotionStep> steps = model.motionSteps();
  const double* numbers = q.data();
  kernelFor<internal::ForwardKinematicsKernel>(cpuLanes())
      .one(steps.data(), static_cast<int>(steps.size()), &numbers, out.X_WB.front().R.data());
}

BodyPoses forwardKinematics(const Model& model, const VectorArg& q) {
  BodyPoses poses;
  forwardKinematics(model, q, poses);
  return poses;
}

void internal::requireQuaternions(const Model& model, const double* q) {
  for (const MotionStep& step : model.motionSteps()) {
    if (step.kind == MotionStep::Kind::kQuaternion)
      static_cast<void>(rotationFromQuaternion(Quaternion(q + step.qIndex)));
  }
}

}  // namespace rex
