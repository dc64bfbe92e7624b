#pragma once

#include <functional>

#include "dynamics/mass_matrix.h"

namespace rex {

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
