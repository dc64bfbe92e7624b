#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// The acceleration a (nv) that forces u cause: M(q) a + F(q, v) = u, by articulated bodies (Featherstone,
/// Rigid Body Dynamics Algorithms, table 7.1); where joints mimic others, by the mass matrix. Throws as
/// inverseDynamics, and for a joint that moves no mass, naming it and the body that needs some.
[[nodiscard]] Eigen::VectorXd forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                              const VectorArg& u,
                                              const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns a, which must be nv already and may be u or v.
void forwardDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& u,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> a);

/// The same by solving with the mass matrix: slower than articulated bodies, and a second opinion. Throws as
/// forwardDynamics. Slide 3:29.
[[nodiscard]] Eigen::VectorXd forwardDynamicsByMassMatrix(const Model& model, const VectorArg& q,
                                                          const VectorArg& v, const VectorArg& u,
                                                          const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
