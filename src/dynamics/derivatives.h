#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

// Exact derivatives of inverse and forward dynamics. They take a few times as long as the dynamics, and
// differences 2 nv times. A derivative by q is one along each entry of v, as integrate() moves q; for
// quaternions, v, a and u are held fixed in the moved frame. Carpentier, Mansard 2018, Analytical derivatives
// of rigid body dynamics algorithms.

/// du/dq, du/dv and du/da = M(q) of u = M(q) a + F(q, v), nv x nv each.
struct InverseDynamicsDerivatives {
  Eigen::MatrixXd u_q, u_v, u_a;
};
/// Throws as inverseDynamics.
[[nodiscard]] InverseDynamicsDerivatives inverseDynamicsDerivatives(
    const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
    const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. Resizes the matrices, which allocates at most once.
void inverseDynamicsDerivatives(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& a, const Eigen::Vector3d& gravity_W,
                                DynamicsWorkspace& workspace, InverseDynamicsDerivatives& out);

/// The acceleration a that u causes, and da/dq, da/dv and da/du = M^-1, nv x nv each.
struct ForwardDynamicsDerivatives {
  Eigen::VectorXd a;
  Eigen::MatrixXd a_q, a_v, a_u;
};
/// Throws as forwardDynamics.
[[nodiscard]] ForwardDynamicsDerivatives forwardDynamicsDerivatives(
    const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
    const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. Resizes vector and matrices, which allocates at most once.
void forwardDynamicsDerivatives(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& u, const Eigen::Vector3d& gravity_W,
                                DynamicsWorkspace& workspace, ForwardDynamicsDerivatives& out);

}  // namespace rex
