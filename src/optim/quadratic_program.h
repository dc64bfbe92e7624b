#pragma once

#include <vector>

#include "base/require.h"

namespace rex {

enum class QuadraticStatus { kOptimal, kInfeasible, kStalled };

/// The result of a quadratic program, with numbers that prove it by substitution:
/// kOptimal: lower <= A x <= upper and H x + g = A^T y, where y_i > 0 only at the lower bound of row i and
/// y_i < 0 only at its upper one. kInfeasible: A^T y = 0, but the bounds alone demand that y.(A x) > 0.
/// kStalled: nothing.
struct QuadraticSolution {
  QuadraticStatus status = QuadraticStatus::kStalled;
  Eigen::VectorXd x{};  ///< n
  Eigen::VectorXd y{};  ///< m, the dual variables of the rows
  double value = 0;     ///< 1/2 x.H x + g.x
  double residual = 0;  ///< if kOptimal, the largest violation of the conditions above, relative to the data
  std::vector<int> active{};  ///< rows with y != 0, in the order in which they were found
  int iterations = 0;         ///< rows added or dropped
};

/// Minimises 1/2 x.H x + g.x subject to lower <= A x <= upper, with A of m x n; equal bounds are an equation,
/// infinite ones are none. H and A are fixed; g and the bounds vary, as in model-predictive control. Meant
/// for at most some hundred variables: one O(n^2) update for each row that becomes active or inactive.
class QuadraticProgram {
 public:
  /// Throws Error for sizes that do not fit, numbers that are not finite, and an H whose symmetric part is
  /// not positive definite.
  QuadraticProgram(const MatrixArg& H, const MatrixArg& A);

  /// By the dual active set method (Goldfarb and Idnani, 1983). `guess`: rows that are tried first, such as
  /// those active in the last solution; it changes the work, not the answer. Throws Error for sizes that do
  /// not fit, numbers that are not finite (bounds may be infinite outwards), lower > upper, and rows that are
  /// not there.
  [[nodiscard]] QuadraticSolution minimize(const VectorArg& g, const VectorArg& lower, const VectorArg& upper,
                                           const std::vector<int>& guess = {}) const;

 private:
  Eigen::MatrixXd H_{};
  Eigen::MatrixXd At_{};         // A^T with columns of length one, or zero
  Eigen::VectorXd rowLength_{};  // of the A given
  Eigen::MatrixXd J_{};          // inverse transpose of the Cholesky factor of H_: J J^T = H^-1
};

}  // namespace rex
