#pragma once

#include <functional>

#include "dynamics/mass_matrix.h"

namespace rex {

/// L(q, v) = T - U in joules, of plain coordinates: v is the rate of q.
using Lagrangian = std::function<double(const Eigen::VectorXd& q, const Eigen::VectorXd& v)>;

// Derivatives are numeric, by differences of eighth order: good to about 1e-10 relative for functions that
// change over one unit of q and v. They are for checking what was derived by hand.

/// The force u = d/dt dL/dv - dL/dq that the Euler-Lagrange equation demands for acceleration a. Slides 3:20
/// and 3:22. Throws Error naming both sizes for v and a unlike q, and if L is not finite.
[[nodiscard]] Eigen::VectorXd eulerLagrangeForce(const Lagrangian& L, const VectorArg& q, const VectorArg& v,
                                                 const VectorArg& a);

/// M and F of M(q) a + F(q, v) = u, with gravity if it is in L. Throws as eulerLagrangeForce. Slide 3:24.
[[nodiscard]] EquationOfMotion equationOfMotion(const Lagrangian& L, const VectorArg& q, const VectorArg& v);

}  // namespace rex
