#pragma once

#include <string>

#include "base/vector_arg.h"

namespace rex::internal {

/// Throws Error "matrix NAME: found entries that are not finite".
void requireFiniteMatrix(const std::string& name, const MatrixArg& M);

/// M without what rounding made unequal in its two halves.
Eigen::MatrixXd symmetricPart(const MatrixArg& M);

/// Throws Error, naming it, unless M is n x n, finite and symmetric.
void requireSymmetric(const std::string& name, const MatrixArg& M, Eigen::Index n);

/// Throws Error with the least eigenvalue unless a symmetric M is positive definite beyond rounding, whatever
/// the units of its rows.
void requirePositiveDefinite(const std::string& name, const MatrixArg& M);

}  // namespace rex::internal
