#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// Inverse dynamics of many states, one per column of Q (nq x N), V and A (nv x N), into the columns of U,
/// which must already be nv x N and not alias the others. Bitwise equal to inverseDynamics, and throws as it.
void inverseDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& A,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> U);

/// Forward dynamics of many states: the columns of A become the accelerations caused by those of U. A must
/// already be nv x N and not alias the others. Bitwise equal to forwardDynamics. Throws as forwardDynamics;
/// columns before the faulty one may have been written.
void forwardDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& U,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> A);

}  // namespace rex
