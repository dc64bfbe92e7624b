#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// In joules. The potential energy is zero if the centre of mass is at the height of the world's origin.
struct Energy {
  double kinetic = 0, potential = 0;
  [[nodiscard]] double total() const { return kinetic + potential; }
};

/// T = sum of m v^2 / 2 + w^T I w / 2, and U = -sum of m g^T p, over all bodies with mass, including those
/// that cannot move, and what the armature and the springs of joints hold. Slides 3:22 and 3:25. Throws as
/// inverseDynamics.
[[nodiscard]] Energy energy(const Model& model, const VectorArg& q, const VectorArg& v,
                            const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops.
[[nodiscard]] Energy energy(const Model& model, const VectorArg& q, const VectorArg& v,
                            const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace);

/// Derivatives of the total energy T + U (nv each).
struct EnergyGradient {
  Eigen::VectorXd byPosition;  ///< along each entry of v, as by integrate(), with v held fixed
  Eigen::VectorXd byVelocity;  ///< M v: the generalised momenta
};

/// dE/dq and dE/dv. Along a motion dE/dt = byPosition . v + byVelocity . a. Throws as inverseDynamics.
[[nodiscard]] EnergyGradient energyGradient(const Model& model, const VectorArg& q, const VectorArg& v,
                                            const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
