#pragma once

#include <vector>

#include <Eigen/Core>

// The solvers that exercises need, compiled once: a main.cpp that instantiates Eigen's own takes seconds
// longer to compile.
namespace rex {

/// Inverse of a square matrix, n x n. Throws Error if A is not square, is singular to working precision, or
/// has entries that are not finite.
[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
/// X with A X = B, for square A (n x n) and B with n rows: a vector for a vector, a matrix for a matrix.
/// Throws as inverse, and for a B with another number of rows or with entries that are not finite.
[[nodiscard]] Eigen::MatrixXd solveMatrix(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
template <class Right>
[[nodiscard]] auto solve(const Eigen::MatrixXd& A, const Eigen::MatrixBase<Right>& B) {
  return Eigen::Matrix<double, Eigen::Dynamic, Right::ColsAtCompileTime>(solveMatrix(A, B));
}
/// The X of smallest norm among those that minimise |A X - B|, for any A (m x n) and B with m rows: a vector
/// for a vector, a matrix for a matrix. Throws Error for a B with another number of rows, and for numbers
/// that are not finite.
[[nodiscard]] Eigen::MatrixXd leastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
template <class Right>
[[nodiscard]] auto leastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixBase<Right>& B) {
  return Eigen::Matrix<double, Eigen::Dynamic, Right::ColsAtCompileTime>(leastSquares(A, Eigen::MatrixXd(B)));
}
/// One entry of a sparse matrix.
struct MatrixEntry {
  int row = 0, column = 0;
  double value = 0;
};
/// The x with H x = b for a sparse, symmetric, positive definite H (n x n, both triangles given), by a
/// sparse Cholesky factorisation. Entries with the same row and column are summed. Throws Error for an
/// entry outside H, an H that is not symmetric or not positive definite to working precision, and numbers
/// that are not finite.
[[nodiscard]] Eigen::VectorXd solveSparse(const std::vector<MatrixEntry>& H, const Eigen::VectorXd& b);
/// Eigenvalues of a square matrix, n complex numbers in no particular order. Throws Error if A is not square,
/// and for numbers that are not finite.
[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// A = U diag(s) V^T with orthonormal columns in U (m x k) and V (n x k), k = min(m, n), and s in
/// descending order.
struct SingularValues {
  Eigen::MatrixXd U;
  Eigen::VectorXd s;
  Eigen::MatrixXd V;
};
/// Throws Error for numbers that are not finite.
[[nodiscard]] SingularValues svd(const Eigen::MatrixXd& A);

}  // namespace rex
