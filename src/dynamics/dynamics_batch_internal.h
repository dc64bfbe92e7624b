#pragma once

#include "dynamics/dynamics_batch.h"
#include "dynamics/kernels_internal.h"

namespace rex::internal {

/// The functions of dynamics_batch.h by kernels of the caller's choice.
void inverseDynamicsBatch(const InverseDynamicsKernel& kernel, const Model& model, const MatrixArg& Q,
                          const MatrixArg& V, const MatrixArg& A, const Eigen::Vector3d& gravity_W,
                          DynamicsWorkspace& workspace, Eigen::Ref<Eigen::MatrixXd> U);
void forwardDynamicsBatch(const ForwardDynamicsKernel& kernel, const Model& model, const MatrixArg& Q,
                          const MatrixArg& V, const MatrixArg& U, const Eigen::Vector3d& gravity_W,
                          DynamicsWorkspace& workspace, Eigen::Ref<Eigen::MatrixXd> A);

}  // namespace rex::internal
