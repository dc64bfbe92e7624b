#include "dynamics/mass_matrix.h"

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/mass_matrix_kernel_internal.h"
#include "dynamics/requirements_internal.h"

namespace rex {

void massMatrix(const Model& model, const VectorArg& q, DynamicsWorkspace& workspace,
                Eigen::Ref<Eigen::MatrixXd> M) {
  internal::requirePositions(model, q);
  requireSize("rows of the mass matrix M", M.rows(), model.nv());
  requireSize("columns of the mass matrix M", M.cols(), model.nv());
  const auto kernel = kernelFor<internal::MassMatrixKernel>(cpuLanes());
  kernel.one(model.links().data(), static_cast<int>(model.links().size()), q.data(),
             internal::roomFor(kernel, model, 1, workspace), M.data(), M.outerStride(), model.nv());
}

Eigen::MatrixXd massMatrix(const Model& model, const VectorArg& q) {
  DynamicsWorkspace workspace;
  Eigen::MatrixXd M(model.nv(), model.nv());
  massMatrix(model, q, workspace, M);
  return M;
}

EquationOfMotion equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                  const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  EquationOfMotion motion;
  equationOfMotion(model, q, v, gravity_W, workspace, motion);
  return motion;
}

void equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                      const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace, EquationOfMotion& out) {
  out.M.resize(model.nv(), model.nv());
  out.F.resize(model.nv());
  massMatrix(model, q, workspace, out.M);
  biasForces(model, q, v, gravity_W, workspace, out.F);
}

}  // namespace rex
