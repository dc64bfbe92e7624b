#include "dynamics/inverse_dynamics.h"

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/inverse_dynamics_kernel_internal.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/requirements_internal.h"

namespace rex {

void inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> u) {
  internal::requirePositions(model, q);
  internal::requireVelocities(model, v);
  requireSize("joint accelerations a", a.size(), model.nv());
  requireSize("joint forces u", u.size(), model.nv());
  const auto kernel = kernelFor<internal::InverseDynamicsKernel>(cpuLanes());
  const double *positions = q.data(), *velocities = v.data(), *accelerations = a.data();
  double* forces = u.data();
  kernel.one({.links = model.links().data(),
              .linkCount = static_cast<int>(model.links().size()),
              .nv = model.nv(),
              .gravity_W = gravity_W.data(),
              .q = &positions,
              .v = &velocities,
              .given = &accelerations,
              .result = &forces,
              .memory = internal::roomFor(kernel, model, 1, workspace)});
}

Eigen::VectorXd inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& a, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd u(model.nv());
  inverseDynamics(model, q, v, a, gravity_W, workspace, u);
  return u;
}

void biasForces(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W,
                DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> F) {
  workspace.zeros.setZero(model.nv());
  inverseDynamics(model, q, v, workspace.zeros, gravity_W, workspace, F);
}

Eigen::VectorXd biasForces(const Model& model, const VectorArg& q, const VectorArg& v,
                           const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd F(model.nv());
  biasForces(model, q, v, gravity_W, workspace, F);
  return F;
}

void gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                   DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> G) {
  workspace.zeros.setZero(model.nv());
  inverseDynamics(model, q, workspace.zeros, workspace.zeros, gravity_W, workspace, G);
}

Eigen::VectorXd gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd G(model.nv());
  gravityForces(model, q, gravity_W, workspace, G);
  return G;
}

}  // namespace rex
