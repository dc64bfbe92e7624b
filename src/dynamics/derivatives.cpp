#include "dynamics/derivatives.h"

#include <algorithm>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/buoyancy_internal.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/mass_factor_internal.h"

namespace rex {
namespace {

void differentiate(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                   const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace, Eigen::MatrixXd& u_q,
                   Eigen::MatrixXd& u_v, Eigen::MatrixXd& u_a) {
  const int n = model.nv();
  u_q.resize(n, n), u_v.resize(n, n), u_a.resize(n, n);
  const auto kernel = kernelFor<internal::DerivativesKernel>(cpuLanes());
  const double *positions = q.data(), *velocities = v.data(), *accelerations = a.data();
  double* const derivatives[] = {u_q.data(), u_v.data(), u_a.data()};
  kernel.one({.links = model.links().data(),
              .linkCount = static_cast<int>(model.links().size()),
              .nv = n,
              .gravity_W = gravity_W.data(),
              .q = &positions,
              .v = &velocities,
              .given = &accelerations,
              .result = derivatives,
              .memory = internal::roomFor(kernel, model, 1, workspace)});
  u_a.diagonal() += model.armature();
  internal::subtractBuoyancyDerivative(model, q, gravity_W, u_q);
}

}  // namespace

void inverseDynamicsDerivatives(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& a, const Eigen::Vector3d& gravity_W,
                                DynamicsWorkspace& workspace, InverseDynamicsDerivatives& out) {
  internal::requirePositions(model, q);
  internal::requireVelocities(model, v);
  requireSize("joint accelerations a", a.size(), model.nv());
  differentiate(model, q, v, a, gravity_W, workspace, out.u_q, out.u_v, out.u_a);
}

InverseDynamicsDerivatives inverseDynamicsDerivatives(const Model& model, const VectorArg& q,
                                                      const VectorArg& v, const VectorArg& a,
                                                      const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  InverseDynamicsDerivatives derivatives;
  inverseDynamicsDerivatives(model, q, v, a, gravity_W, workspace, derivatives);
  return derivatives;
}

// 0 = du - dID at the acceleration that u causes, with dID = u_q dq + u_v dv + M da.
void forwardDynamicsDerivatives(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& u, const Eigen::Vector3d& gravity_W,
                                DynamicsWorkspace& workspace, ForwardDynamicsDerivatives& out) {
  out.a.resize(model.nv());
  forwardDynamics(model, q, v, u, gravity_W, workspace, out.a);
  Eigen::MatrixXd& M = workspace.M;
  differentiate(model, q, v, out.a, gravity_W, workspace, out.a_q, out.a_v, M);
  internal::factorFromLast(model, M);
  const int n = model.nv(), stride = (3 * n + 3) / 4 * 4;
  constexpr std::size_t kPerLine = sizeof(DynamicsWorkspace::Line) / sizeof(double);
  workspace.lines.resize(
      std::max(workspace.lines.size(), static_cast<std::size_t>(n * stride) / kPerLine + 1));
  double* numbers = workspace.lines.front().numbers;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> all(numbers, n, stride);
  all.leftCols(n) = -out.a_q;
  all.middleCols(n, n) = -out.a_v;
  all.rightCols(stride - 2 * n).setIdentity();
  kernelFor<internal::DerivativesKernel>(cpuLanes()).solve(M.data(), numbers, n, stride);
  out.a_q = all.leftCols(n);
  out.a_v = all.middleCols(n, n);
  out.a_u = all.middleCols(2 * n, n);
}

ForwardDynamicsDerivatives forwardDynamicsDerivatives(const Model& model, const VectorArg& q,
                                                      const VectorArg& v, const VectorArg& u,
                                                      const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  ForwardDynamicsDerivatives derivatives;
  forwardDynamicsDerivatives(model, q, v, u, gravity_W, workspace, derivatives);
  return derivatives;
}

}  // namespace rex
