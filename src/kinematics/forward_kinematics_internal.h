#pragma once

#include "kinematics/forward_kinematics.h"
#include "kinematics/forward_kinematics_kernel_internal.h"

namespace rex::internal {

/// forwardKinematicsBatch() by a kernel of the caller's choice.
void forwardKinematicsBatch(const ForwardKinematicsKernel& kernel, const Model& model, const MatrixArg& Q,
                            PoseBatch& out);

/// Whether q has quaternions; nothing else makes it longer than v.
inline bool hasQuaternions(const Model& model) { return model.nq() != model.nv(); }
/// Throws Error unless the quaternions in q are finite and not zero.
void requireQuaternions(const Model& model, const double* q);

}  // namespace rex::internal
