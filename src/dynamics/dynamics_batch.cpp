#include "dynamics/dynamics_batch.h"

#include <algorithm>
#include <array>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "dynamics/buoyancy_internal.h"
#include "dynamics/dynamics_batch_internal.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/requirements_internal.h"

namespace rex {
namespace {

using internal::DynamicsTask;

constexpr int kMostLanes = 4;

// Names of the columns of V, A and U in messages: one column, and all of them.
struct Names {
  const char *column, *columns;
};
constexpr Names kVelocities{"joint velocities V, a column", "joint velocities V, columns"};
constexpr Names kAccelerations{"joint accelerations A, a column", "joint accelerations A, columns"};
constexpr Names kForces{"joint forces U, a column", "joint forces U, columns"};

// Requires as many columns as Q has, each as long as v.
void requireColumns(const Names& names, const MatrixArg& columns, const Model& model, const MatrixArg& Q) {
  requireSize(names.column, columns.rows(), model.nv());
  requireSize(names.columns, columns.cols(), Q.cols());
}

void requireStates(const Model& model, const MatrixArg& Q, const MatrixArg& V) {
  requireSize("joint positions Q, a column", Q.rows(), model.nq());
  if (model.nq() != model.nv()) {
    for (const auto& q : Q.colwise()) internal::requirePositions(model, q);
  }
  requireColumns(kVelocities, V, model, Q);
}

// Calls solve(task) for each block of columns; the last block may repeat the last column.
template <class Kernel, class Solve>
void forEachBlock(const Kernel& kernel, const Model& model, const MatrixArg& Q, const MatrixArg& V,
                  const MatrixArg& G, const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                  Eigen::Ref<Eigen::MatrixXd> R, const Solve& solve) {
  constexpr int kBlock = DynamicsTask::kBlock;
  std::array<const double*, kBlock> q, v, given;
  std::array<double*, kBlock> result;
  const DynamicsTask task{.links = model.links().data(),
                          .linkCount = static_cast<int>(model.links().size()),
                          .nv = model.nv(),
                          .gravity_W = gravity_W.data(),
                          .q = q.data(),
                          .v = v.data(),
                          .given = given.data(),
                          .result = result.data(),
                          .memory = internal::roomFor(kernel, model, kMostLanes, workspace)};
  for (Eigen::Index begin = 0; begin < Q.cols(); begin += kBlock) {
    for (int i = 0; i < kBlock; ++i) {
      const Eigen::Index k = std::min(begin + i, Q.cols() - 1);
      const std::size_t lane = static_cast<std::size_t>(i);
      q[lane] = Q.col(k).data();
      v[lane] = V.col(k).data();
      given[lane] = G.col(k).data();
      result[lane] = R.col(k).data();
    }
    solve(task);
  }
}

}  // namespace

void internal::inverseDynamicsBatch(const InverseDynamicsKernel& kernel, const Model& model,
                                    const MatrixArg& Q, const MatrixArg& V, const MatrixArg& A,
                                    const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                                    Eigen::Ref<Eigen::MatrixXd> U) {
  requireStates(model, Q, V);
  requireColumns(kAccelerations, A, model, Q);
  requireColumns(kForces, U, model, Q);
  forEachBlock(kernel, model, Q, V, A, gravity_W, workspace, U, kernel.block);
  for (Eigen::Index k = 0; k < Q.cols() && model.hasBuoyancy(); ++k)
    addBuoyancy(model, Q.col(k), gravity_W, -1, workspace, U.col(k));
}

void internal::forwardDynamicsBatch(const ForwardDynamicsKernel& kernel, const Model& model,
                                    const MatrixArg& Q, const MatrixArg& V, const MatrixArg& U,
                                    const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                                    Eigen::Ref<Eigen::MatrixXd> A) {
  requireStates(model, Q, V);
  requireColumns(kForces, U, model, Q);
  requireColumns(kAccelerations, A, model, Q);
  if (hasMimics(model) || model.hasBuoyancy()) {
    for (Eigen::Index k = 0; k < Q.cols(); ++k)
      forwardDynamics(model, Q.col(k), V.col(k), U.col(k), gravity_W, workspace, A.col(k));
    return;
  }
  forEachBlock(kernel, model, Q, V, U, gravity_W, workspace, A, [&](const DynamicsTask& task) {
    const int link = kernel.block(task);
    if (link != ForwardDynamicsKernel::kRegular) throwSingular(model, jointOfLink(model, link));
  });
}

void inverseDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& A,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> U) {
  internal::inverseDynamicsBatch(kernelFor<internal::InverseDynamicsKernel>(cpuLanes()), model, Q, V, A,
                                 gravity_W, workspace, U);
}

void forwardDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& U,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> A) {
  internal::forwardDynamicsBatch(kernelFor<internal::ForwardDynamicsKernel>(cpuLanes()), model, Q, V, U,
                                 gravity_W, workspace, A);
}

}  // namespace rex
