#pragma once

#include "scene/model.h"

namespace rex {

/// Inverse dynamics as inverseDynamics() in dynamics/inverse_dynamics.h, but slowly and plainly: all twists
/// in W, straight from the freedoms and the inertias of the model, which it knows no links of.
[[nodiscard]] Eigen::VectorXd worldFrameInverseDynamics(const Model& model, const VectorArg& q,
                                                        const VectorArg& v, const VectorArg& a,
                                                        const Eigen::Vector3d& gravity_W);

}  // namespace rex
