#include "kinematics/forward_kinematics.h"

#include <cmath>

namespace rex {
namespace {

// X_WP * X_PC, with X_PC given as [R p]. By columns: Eigen's product of small matrices takes twice as long.
void compose(const Pose& X_WP, const LinearMotion::Matrix34& X_PC, Pose& X_WC) {
  const Eigen::Vector3d x = X_WP.R.col(0), y = X_WP.R.col(1), z = X_WP.R.col(2);
  for (int i = 0; i < 3; ++i) X_WC.R.col(i) = X_PC(0, i) * x + X_PC(1, i) * y + X_PC(2, i) * z;
  X_WC.p = X_PC(0, 3) * x + X_PC(1, 3) * y + X_PC(2, 3) * z + X_WP.p;
}

void place(const Joint& joint, const double* q, const Pose& X_WP, Pose& X_WC) {
  const LinearMotion& motion = joint.motion;
  if (joint.type == JointType::kHinge) {
    compose(X_WP, motion.constant + std::cos(*q) * motion.first + std::sin(*q) * motion.second, X_WC);
  } else if (joint.type == JointType::kSlider) {
    compose(X_WP, motion.constant + *q * motion.first, X_WC);
  } else {
    X_WC = X_WP * joint.X_PF * jointMotion(joint.type, joint.axis, q) * joint.X_MC;
  }
}

}  // namespace

void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out) {
  requireSize("joint positions q", q.size(), model.nq());
  out.X_WB.resize(model.bodies().size());
  Pose* X_WB = out.X_WB.data();
  for (const Body& body : model.bodies()) {
    if (body.joint == kNoJoint) {
      *X_WB++ = body.X_PB;  // roots hang on the world
    } else {
      const Joint& joint = model[body.joint];
      place(joint, q.data() + joint.qIndex, out[body.parent], *X_WB++);
    }
  }
}

BodyPoses forwardKinematics(const Model& model, const VectorArg& q) {
  BodyPoses poses;
  forwardKinematics(model, q, poses);
  return poses;
}

}  // namespace rex
