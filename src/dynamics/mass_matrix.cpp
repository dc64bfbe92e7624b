#include "dynamics/mass_matrix.h"

#include "base/error.h"
#include "kinematics/jacobians.h"

namespace rex {

void massMatrix(const Model& model, const VectorArg& q, DynamicsWorkspace&, Eigen::Ref<Eigen::MatrixXd> M) {
  requireSize("rows of the mass matrix M", M.rows(), model.nv());
  requireSize("columns of the mass matrix M", M.cols(), model.nv());
  const BodyPoses poses = forwardKinematics(model, q);
  M.setZero();
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    const BodyId id{static_cast<int>(i)};
    const Eigen::Matrix3Xd J = positionJacobian(model, poses, id, body.p_BBcm);
    const Eigen::Matrix3Xd Jw = poses[id].R.transpose() * angularJacobian(model, poses, id);
    M += body.mass * J.transpose() * J + Jw.transpose() * body.I_BBcm_B * Jw;
  }
}

Eigen::MatrixXd massMatrix(const Model& model, const VectorArg& q) {
  DynamicsWorkspace workspace;
  Eigen::MatrixXd M(model.nv(), model.nv());
  massMatrix(model, q, workspace, M);
  return M;
}

EquationOfMotion equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                  const Eigen::Vector3d& gravity_W) {
  return {massMatrix(model, q), biasForces(model, q, v, gravity_W)};
}

}  // namespace rex
