#pragma once

#include "kinematics/jacobian_kernel_internal.h"
#include "kinematics/jacobians.h"

namespace rex::internal {

/// The Jacobians by a kernel of the caller's choice.
void positionJacobianBatch(const JacobianKernel& kernel, const Model& model, const PoseBatch& poses,
                           BodyId body, const Eigen::Vector3d& p_BQ, JacobianBatch& out);
void angularJacobianBatch(const JacobianKernel& kernel, const Model& model, const PoseBatch& poses,
                          BodyId body, JacobianBatch& out);

}  // namespace rex::internal
