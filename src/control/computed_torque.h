#pragma once

#include "control/reference.h"
#include "dynamics/inverse_dynamics.h"

namespace rex {

/// The forces u (nv) with which every joint follows the reference like a unit point mass on a spring: u = M
/// a* + F with the a* of followReference, computed by inverse dynamics without forming M. Slides 3:29 and
/// 3:30. Allocates. Throws Error like followReference and inverseDynamics, and for a gravity that is not
/// finite.
[[nodiscard]] Eigen::VectorXd computedTorque(const Model& model, const State& state,
                                             const Reference& reference, const PdGains& gains,
                                             const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
