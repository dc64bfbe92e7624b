#pragma once

#include <functional>

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// M(q), nv x nv, symmetric: kinetic energy is v^T M v / 2. By the composite-rigid-body algorithm;
/// Featherstone, Rigid Body Dynamics Algorithms, table 6.2. Throws as inverseDynamics.
[[nodiscard]] Eigen::MatrixXd massMatrix(const Model& model, const VectorArg& q);
/// Overload for hot loops. The caller owns M, which must be nv x nv already.
void massMatrix(const Model& model, const VectorArg& q, DynamicsWorkspace& workspace,
                Eigen::Ref<Eigen::MatrixXd> M);

/// M and F of M(q) a + F(q, v) = u. Slide 3:28.
struct EquationOfMotion {
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
};
[[nodiscard]] EquationOfMotion equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                                const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. Resizes M and F, which allocates at most once.
void equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                      const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace, EquationOfMotion& out);

/// C(q, v), nv x nv, of M(q) a + C(q, v) v + G(q) = u. Of the many matrices with C v = F - G it is the one
/// of the Christoffel symbols if no coordinate is a quaternion. Always dM/dt = C + C^T, so that dM/dt - 2 C
/// is skew-symmetric. Slide 3:28; Echeandia, Wensing 2021, Numerical methods to compute the Coriolis
/// matrix, algorithm 1. Throws as inverseDynamics.
[[nodiscard]] Eigen::MatrixXd coriolisMatrix(const Model& model, const VectorArg& q, const VectorArg& v);

/// L(q, v) = T - U in joules, in coordinates without quaternions: v is the derivative of q.
using Lagrangian = std::function<double(const Eigen::VectorXd& q, const Eigen::VectorXd& v)>;

// Derivatives are numeric, by differences of eighth order, with a relative error of about 1e-10 for
// functions that vary on a scale of one unit of q and v. They serve to check derivations by hand.

/// The force u = d/dt dL/dv - dL/dq that the Euler-Lagrange equation requires for the acceleration a. Slides
/// 3:20 and 3:22. Throws Error naming both sizes if those of v or a differ from q's, and if L is not finite.
[[nodiscard]] Eigen::VectorXd eulerLagrangeForce(const Lagrangian& L, const VectorArg& q, const VectorArg& v,
                                                 const VectorArg& a);

/// M and F of M(q) a + F(q, v) = u, including gravity if L does. Throws as eulerLagrangeForce. Slide 3:22.
[[nodiscard]] EquationOfMotion equationOfMotion(const Lagrangian& L, const VectorArg& q, const VectorArg& v);

}  // namespace rex
