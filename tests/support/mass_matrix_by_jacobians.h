#pragma once

#include "kinematics/jacobians.h"

namespace rex {

/// The mass matrix as slide 3:22 defines it, a sum over bodies: slow, and independent of any recursion.
inline Eigen::MatrixXd massMatrixByJacobians(const Model& model, const Eigen::VectorXd& q) {
  const BodyPoses poses = forwardKinematics(model, q);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(model.nv(), model.nv());
  for (int i = 1; i < static_cast<int>(model.bodies().size()); ++i) {
    const BodyId id{i};
    const Eigen::Matrix3Xd J = positionJacobian(model, poses, id, model[id].p_BBcm);
    const Eigen::Matrix3Xd Jw = poses[id].R.transpose() * angularJacobian(model, poses, id);
    if (model[id].joint != kNoJoint) {
      const Joint& joint = model[model[id].joint];
      M.diagonal().segment(joint.vIndex, joint.nv).array() += joint.ratio * joint.ratio * joint.armature;
    }
    M += model[id].mass * J.transpose() * J + Jw.transpose() * model[id].I_BBcm_B * Jw;
  }
  return M;
}

}  // namespace rex
