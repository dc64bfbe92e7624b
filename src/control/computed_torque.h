#pragma once

#include "control/reference.h"
#include "dynamics/inverse_dynamics.h"

namespace rex {

/// The forces u (nv) under which every joint follows the reference like a point of mass one on a spring: u =
/// M a* + F with the a* of followReference, by inverse dynamics, which forms no M. Slides 3:29 and 3:30.
/// It allocates. Throws Error as followReference and inverseDynamics, and for a gravity that is not finite.
[[nodiscard]] Eigen::VectorXd computedTorque(const Model& model, const State& state,
                                             const Reference& reference, const PdGains& gains,
                                             const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
