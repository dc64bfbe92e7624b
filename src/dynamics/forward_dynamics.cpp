#include "dynamics/forward_dynamics.h"

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/buoyancy_internal.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "dynamics/mass_factor_internal.h"
#include "dynamics/requirements_internal.h"

namespace rex {
namespace {

constexpr int kRegular = internal::ForwardDynamicsKernel::kRegular;

void byMassMatrix(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                  const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                  Eigen::Ref<Eigen::VectorXd> a) {
  workspace.M.resize(model.nv(), model.nv());
  workspace.F.resize(model.nv());
  massMatrix(model, q, workspace, workspace.M);
  biasForces(model, q, v, gravity_W, workspace, workspace.F);
  workspace.F = u - workspace.F;
  internal::factorFromLast(model, workspace.M);
  internal::solveFromLast(workspace.M, workspace.F);
  a = workspace.F;
}

void requireSizes(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u) {
  internal::requirePositions(model, q);
  internal::requireVelocities(model, v);
  requireSize("joint forces u", u.size(), model.nv());
}

}  // namespace

void forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> a) {
  requireSizes(model, q, v, u);
  requireSize("joint accelerations a", a.size(), model.nv());
  if (internal::hasMimics(model)) return byMassMatrix(model, q, v, u, gravity_W, workspace, a);
  const auto kernel = kernelFor<internal::ForwardDynamicsKernel>(cpuLanes());
  const double *positions = q.data(), *velocities = v.data(), *forces = u.data();
  if (model.hasBuoyancy()) {
    workspace.F = u;
    internal::addBuoyancy(model, q, gravity_W, 1, workspace, workspace.F);
    forces = workspace.F.data();
  }
  double* accelerations = a.data();
  const int link = kernel.one({.links = model.links().data(),
                               .linkCount = static_cast<int>(model.links().size()),
                               .nv = model.nv(),
                               .gravity_W = gravity_W.data(),
                               .q = &positions,
                               .v = &velocities,
                               .given = &forces,
                               .result = &accelerations,
                               .memory = internal::roomFor(kernel, model, 1, workspace)});
  if (link != kRegular) internal::throwSingular(model, internal::jointOfLink(model, link));
}

Eigen::VectorXd forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& u, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd a(model.nv());
  forwardDynamics(model, q, v, u, gravity_W, workspace, a);
  return a;
}

Eigen::VectorXd forwardDynamicsByMassMatrix(const Model& model, const VectorArg& q, const VectorArg& v,
                                            const VectorArg& u, const Eigen::Vector3d& gravity_W) {
  requireSizes(model, q, v, u);
  DynamicsWorkspace workspace;
  Eigen::VectorXd a(model.nv());
  byMassMatrix(model, q, v, u, gravity_W, workspace, a);
  return a;
}

}  // namespace rex
