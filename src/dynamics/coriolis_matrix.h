#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// C(q, v), nv x nv, of M(q) a + C(q, v) v + G(q) = u. Of the many matrices with C v = F - G it is the one
/// of the Christoffel symbols if no coordinate is a quaternion. Always dM/dt = C + C^T, so that dM/dt - 2 C
/// is skew-symmetric. Slide 3:28; Echeandia, Wensing 2021, Numerical methods to compute the Coriolis
/// matrix, algorithm 1. Throws as inverseDynamics.
[[nodiscard]] Eigen::MatrixXd coriolisMatrix(const Model& model, const VectorArg& q, const VectorArg& v);

}  // namespace rex
