#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex::internal {

/// Adds to u (nv), `sign` times, what carries bodies (BodySpec::buoyancy): at the centre of mass of each
/// -buoyancy * mass * gravity_W. Costs nothing if no body has buoyancy; otherwise places the bodies of the
/// workspace.
void addBuoyancy(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W, double sign,
                 DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> u);

/// Subtracts from u_q (nv x nv) how these forces change with q, whose displacements are as in integrate().
void subtractBuoyancyDerivative(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                                Eigen::MatrixXd& u_q);

}  // namespace rex::internal
