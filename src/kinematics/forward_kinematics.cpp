#include "kinematics/forward_kinematics.h"

namespace rex {

void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out) {
  requireSize("joint positions q", q.size(), model.nq());
  out.X_WB.resize(model.bodies().size());
  std::size_t i = 0;
  for (const Body& body : model.bodies()) {
    Pose& X_WB = out.X_WB[i++];
    if (body.joint == kNoJoint) {
      X_WB = body.X_PB;  // roots hang on the world
      continue;
    }
    const Joint& joint = model[body.joint];
    X_WB = out[body.parent] * joint.X_PF * jointMotion(joint.type, joint.axis, q.data() + joint.qIndex) *
           joint.X_MC;
  }
}

BodyPoses forwardKinematics(const Model& model, const VectorArg& q) {
  BodyPoses poses;
  forwardKinematics(model, q, poses);
  return poses;
}

}  // namespace rex
