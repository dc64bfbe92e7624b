#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// The acceleration a (nv) caused by the joint forces u: M(q) a + F(q, v) = u, by the articulated-body
/// algorithm (Featherstone, Rigid Body Dynamics Algorithms, table 7.1), or, if joints mimic others, by the
/// mass matrix. Throws as inverseDynamics, and for a joint that moves no mass, naming it and the body that
/// needs a mass.
[[nodiscard]] Eigen::VectorXd forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                              const VectorArg& u,
                                              const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns a, which must be nv already and may be u or v.
void forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> a);

/// The same by solving with the mass matrix: slower than the articulated-body algorithm, but an independent
/// check. Throws as forwardDynamics. Slide 3:29.
[[nodiscard]] Eigen::VectorXd forwardDynamicsByMassMatrix(const Model& model, const VectorArg& q,
                                                          const VectorArg& v, const VectorArg& u,
                                                          const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
