#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// Inverse dynamics of many states, one per column of Q (nq x N), V and A (nv x N), into the columns of U (nv
/// x N already, and none of the others): same bits as inverseDynamics for each. Throws as inverseDynamics.
void inverseDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& A,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> U);

/// Forward dynamics of many states: the columns of A (nv x N already) become the accelerations that those of
/// U cause; A is none of the others. Same bits as forwardDynamics for each. Throws as forwardDynamics;
/// columns before the one that it throws for may have been written.
void forwardDynamicsBatch(const Model& model, const MatrixArg& Q, const MatrixArg& V, const MatrixArg& U,
                          const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                          Eigen::Ref<Eigen::MatrixXd> A);

}  // namespace rex
