#pragma once

#include "base/require.h"

namespace rex {

enum class LinearStatus { kOptimal, kInfeasible, kUnbounded, kStalled };

/// The result of a linear program, with numbers that prove it by substitution:
/// kOptimal: A x = b, x >= 0, A^T y <= c and b.y = c.x. kInfeasible: A^T y <= 0 and b.y > 0 (Farkas).
/// kUnbounded: A x = 0, x >= 0 and c.x < 0: along this x the cost decreases without bound. kStalled: nothing.
struct LinearSolution {
  LinearStatus status = LinearStatus::kStalled;
  Eigen::VectorXd x{};  ///< n
  Eigen::VectorXd y{};  ///< m, the dual variables of the rows
  double value = 0;     ///< c.x if kOptimal
  int iterations = 0;
};

/// Minimises c.x subject to A x = b and x >= 0, with A of m x n, by the simplex method in two phases
/// (Dantzig, 1963). Meant for at most a hundred rows and any number of columns: the basis is factored again
/// in each iteration, so errors do not accumulate. Entries smaller than 1e-10 of the others in their row
/// and column count as zero. Throws Error for sizes that do not fit, no rows, and numbers that are not
/// finite.
[[nodiscard]] LinearSolution minimizeLinear(const MatrixArg& A, const VectorArg& b, const VectorArg& c);

}  // namespace rex
