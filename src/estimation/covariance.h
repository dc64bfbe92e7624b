#pragma once

#include <string_view>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

enum class Definiteness { kPositive, kSemidefinite };

/// Throws Error unless A is square of `size`, finite, symmetric and positive definite (or semidefinite),
/// saying which entry or eigenvalue is wrong; `what` names A. Deviations up to 1e-9, relative to the
/// variances of an entry, are tolerated.
void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size,
                       Definiteness wanted = Definiteness::kSemidefinite);

/// Whether the factorisation of A succeeded with pivots above rounding errors.
[[nodiscard]] bool isDefinite(const Eigen::LLT<Eigen::MatrixXd>& factor, const MatrixArg& A);
/// The factorisation of a covariance. Throws Error like requireCovariance unless it is definite in that
/// sense.
[[nodiscard]] Eigen::LLT<Eigen::MatrixXd> definiteFactor(std::string_view what, const MatrixArg& A);

/// (A + A^T) / 2: restores symmetry lost by rounding.
[[nodiscard]] Eigen::MatrixXd symmetrized(const MatrixArg& A);

/// The positive semidefinite matrix nearest to a symmetric A in the Frobenius norm: negative eigenvalues
/// become 0 (Higham 1988).
[[nodiscard]] Eigen::MatrixXd nearestSemidefinite(const MatrixArg& A);

/// Some S with S S^T = A for a semidefinite A; eigenvalues that are negative by rounding count as zero.
[[nodiscard]] Eigen::MatrixXd covarianceRoot(const MatrixArg& A);

}  // namespace rex
