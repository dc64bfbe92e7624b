#include "dynamics/forward_dynamics.h"

#include <cmath>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "dynamics/requirements_internal.h"
#include "scene/state.h"

namespace rex {
namespace {

constexpr int kRegular = internal::ForwardDynamicsKernel::kRegular;

// Solves M x = b by L^T L = M, overwriting both; only the lower half of M is read. It runs from the last
// joint to the first, like the articulated-body algorithm, and so finds the joint that itself moves no mass:
// returns its freedom if there is one, else kRegular.
int solveFromLast(Eigen::MatrixXd& M, Eigen::Ref<Eigen::VectorXd> b) {
  const Eigen::Index n = M.cols();
  const auto below = [&](Eigen::Index k) { return M.col(k).tail(n - 1 - k); };
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    const auto column = below(k);
    const double left = M(k, k) - column.squaredNorm();
    if (left <= internal::ForwardDynamicsKernel::kLeastShare * M(k, k)) return static_cast<int>(k);
    M(k, k) = std::sqrt(left);
    for (Eigen::Index i = 0; i < k; ++i) M(k, i) = (M(k, i) - column.dot(M.col(i).tail(n - 1 - k))) / M(k, k);
    b[k] = (b[k] - column.dot(b.tail(n - 1 - k))) / M(k, k);
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    b[k] /= M(k, k);
    b.tail(n - 1 - k) -= b[k] * below(k);
  }
  return kRegular;
}

void byMassMatrix(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                  const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                  Eigen::Ref<Eigen::VectorXd> a) {
  workspace.M.resize(model.nv(), model.nv());
  workspace.F.resize(model.nv());
  massMatrix(model, q, workspace, workspace.M);
  biasForces(model, q, v, gravity_W, workspace, workspace.F);
  workspace.F = u - workspace.F;
  const int freedom = solveFromLast(workspace.M, workspace.F);
  if (freedom != kRegular) internal::throwSingular(model, jointOfVelocity(model, freedom));
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
