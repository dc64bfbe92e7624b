#pragma once

#include <string_view>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

enum class Definiteness { kPositive, kSemidefinite };

/// Throws Error unless A is square of `size`, finite, symmetric to 1e-9 of its largest entry, and positive
/// definite (or semidefinite to 1e-9), saying which entry or eigenvalue is wrong; `what` names it.
void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size,
                       Definiteness wanted = Definiteness::kSemidefinite);

/// (A + A^T) / 2: what rounding took away from symmetry.
[[nodiscard]] Eigen::MatrixXd symmetrized(const MatrixArg& A);

/// Some S with S S^T = A, of a semidefinite A; what is negative by rounding counts as zero.
[[nodiscard]] Eigen::MatrixXd covarianceRoot(const MatrixArg& A);

}  // namespace rex
