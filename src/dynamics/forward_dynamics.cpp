#include "dynamics/forward_dynamics.h"

#include <Eigen/Cholesky>

#include "base/error.h"
#include "dynamics/mass_matrix.h"

namespace rex {

Eigen::VectorXd forwardDynamicsByMassMatrix(const Model& model, const VectorArg& q, const VectorArg& v,
                                            const VectorArg& u, const Eigen::Vector3d& gravity_W) {
  requireSize("joint forces u", u.size(), model.nv());
  const EquationOfMotion motion = equationOfMotion(model, q, v, gravity_W);
  return motion.M.llt().solve(u - motion.F);
}

void forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace&, Eigen::Ref<Eigen::VectorXd> a) {
  a = forwardDynamicsByMassMatrix(model, q, v, u, gravity_W);
}

Eigen::VectorXd forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& u, const Eigen::Vector3d& gravity_W) {
  return forwardDynamicsByMassMatrix(model, q, v, u, gravity_W);
}

}  // namespace rex
