#pragma once

#include <cmath>

#include "dynamics/kernels_internal.h"
#include "dynamics/requirements_internal.h"
#include "scene/state.h"

namespace rex::internal {

/// Overwrites the lower half of a mass matrix by the L of L^T L = M; only that half is read. It runs from the
/// last joint to the first, like the articulated-body algorithm, and so finds the joint that itself moves no
/// mass: throws Error naming it.
inline void factorFromLast(const Model& model, Eigen::MatrixXd& M) {
  const Eigen::Index n = M.cols();
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    const auto column = M.col(k).tail(n - 1 - k);
    const double left = M(k, k) - column.squaredNorm();
    if (left <= ForwardDynamicsKernel::kLeastShare * M(k, k)) throwSingular(model, jointOfVelocity(model, k));
    M(k, k) = std::sqrt(left);
    for (Eigen::Index i = 0; i < k; ++i) M(k, i) = (M(k, i) - column.dot(M.col(i).tail(n - 1 - k))) / M(k, k);
  }
}

/// Overwrites b by the solution of L^T L x = b.
inline void solveFromLast(const Eigen::MatrixXd& L, Eigen::Ref<Eigen::VectorXd> b) {
  const Eigen::Index n = L.cols();
  for (Eigen::Index k = n - 1; k >= 0; --k)
    b[k] = (b[k] - L.col(k).tail(n - 1 - k).dot(b.tail(n - 1 - k))) / L(k, k);
  for (Eigen::Index k = 0; k < n; ++k) {
    b[k] /= L(k, k);
    b.tail(n - 1 - k) -= b[k] * L.col(k).tail(n - 1 - k);
  }
}

}  // namespace rex::internal
