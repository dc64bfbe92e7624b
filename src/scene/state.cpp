#include "scene/state.h"

#include "base/error.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

// Where the quaternion of a joint stands among its coordinates, or -1.
int quaternionOffset(JointType type) {
  if (type == JointType::kBall) return 0;
  return type == JointType::kFree ? 3 : -1;
}

}  // namespace

State initialState(const Model& model) {
  return {model.initialPositions(), Eigen::VectorXd::Zero(model.nv()), 0};
}

Eigen::VectorXd integrate(const Model& model, const VectorArg& q, const VectorArg& v) {
  requireSize("joint positions q", q.size(), model.nq());
  requireSize("joint velocities v", v.size(), model.nv());
  Eigen::VectorXd next = q;
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    const int quaternion = quaternionOffset(joint.type);
    const int plain = quaternion < 0 ? joint.nq : quaternion;
    next.segment(joint.qIndex, plain) += v.segment(joint.vIndex, plain);
    if (quaternion < 0) continue;
    const Quaternion before = q.segment<4>(joint.qIndex + quaternion);
    const Quaternion turn = quaternionFromRotation(expSO3(v.segment<3>(joint.vIndex + quaternion)));
    next.segment<4>(joint.qIndex + quaternion) = quaternionProduct(before.normalized(), turn).normalized();
  }
  return next;
}

Eigen::VectorXd difference(const Model& model, const VectorArg& q0, const VectorArg& q1) {
  requireSize("joint positions q0", q0.size(), model.nq());
  requireSize("joint positions q1", q1.size(), model.nq());
  Eigen::VectorXd v(model.nv());
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    const int quaternion = quaternionOffset(joint.type);
    const int plain = quaternion < 0 ? joint.nq : quaternion;
    v.segment(joint.vIndex, plain) = q1.segment(joint.qIndex, plain) - q0.segment(joint.qIndex, plain);
    if (quaternion < 0) continue;
    const Eigen::Matrix3d R0 = rotationFromQuaternion(q0.segment<4>(joint.qIndex + quaternion));
    const Eigen::Matrix3d R1 = rotationFromQuaternion(q1.segment<4>(joint.qIndex + quaternion));
    v.segment<3>(joint.vIndex + quaternion) = logSO3(R0.transpose() * R1);
  }
  return v;
}

}  // namespace rex
