#pragma once

#include "dynamics/workspace.h"
#include "scene/model.h"

namespace rex {

// The equation of motion is M(q) a + F(q, v) = u (slide 3:28), with q (nq), and v, its derivative a and the
// joint forces u (nv each; N m or N). Gravity is an acceleration in W, m/s^2. All functions throw Error
// naming both sizes for a vector of the wrong size, and for quaternions that are zero or not finite.

/// (0, 0, -9.81) m/s^2.
inline Eigen::Vector3d earthGravity() { return {0, 0, -9.81}; }

/// The forces u that accelerate the joints by a: u = M(q) a + F(q, v), by the recursive Newton-Euler
/// algorithm. Slide 3:23; Featherstone, Rigid Body Dynamics Algorithms, table 5.1.
[[nodiscard]] Eigen::VectorXd inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                              const VectorArg& a,
                                              const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns u, which must be nv already and may be a or v.
void inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> u);

/// F(q, v), the Coriolis, centrifugal and gravity terms: the forces u at which v stays constant. Slide 3:24.
[[nodiscard]] Eigen::VectorXd biasForces(const Model& model, const VectorArg& q, const VectorArg& v,
                                         const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns F, which must be nv already and may be v.
void biasForces(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W,
                DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> F);

/// G(q), the joint forces that hold the robot still: the gradient of its potential energy. Slide 3:24.
[[nodiscard]] Eigen::VectorXd gravityForces(const Model& model, const VectorArg& q,
                                            const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns G, which must be nv already.
void gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                   DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> G);

}  // namespace rex
