#pragma once

#include <string_view>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

enum class Definiteness { kPositive, kSemidefinite };

/// Throws Error unless A is square of `size`, finite, symmetric and positive definite (or semidefinite),
/// saying which entry or eigenvalue is wrong; `what` names it. Rounding of 1e-9 is forgiven, relative to the
/// variances that belong to an entry.
void requireCovariance(std::string_view what, const MatrixArg& A, Eigen::Index size,
                       Definiteness wanted = Definiteness::kSemidefinite);

/// Whether the factorisation of A succeeded with pivots that are more than rounding.
[[nodiscard]] bool isDefinite(const Eigen::LLT<Eigen::MatrixXd>& factor, const MatrixArg& A);
/// The factorisation of a covariance. Throws Error as requireCovariance unless it is definite in that sense.
[[nodiscard]] Eigen::LLT<Eigen::MatrixXd> definiteFactor(std::string_view what, const MatrixArg& A);

/// (A + A^T) / 2: what rounding took away from symmetry.
[[nodiscard]] Eigen::MatrixXd symmetrized(const MatrixArg& A);

/// The positive semidefinite matrix nearest to a symmetric A, by the sum of its squared entries: what is
/// negative of its eigenvalues becomes 0 (Higham 1988).
[[nodiscard]] Eigen::MatrixXd nearestSemidefinite(const MatrixArg& A);

/// Some S with S S^T = A, of a semidefinite A; what is negative by rounding counts as zero.
[[nodiscard]] Eigen::MatrixXd covarianceRoot(const MatrixArg& A);

}  // namespace rex
