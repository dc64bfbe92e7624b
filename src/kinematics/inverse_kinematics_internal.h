#pragma once

#include <Eigen/Cholesky>

namespace rex::internal {

/// A symmetric, positive definite matrix to measure with; diagonal ones cost no factorisation. Throws Error
/// with `what` if the given matrix has another size than `size` or is none; an empty one is the identity.
class Metric {
 public:
  Metric(const char* what, const Eigen::MatrixXd& given, Eigen::Index size);

  bool isDiagonal() const { return isDiagonal_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  /// metric^-1 M.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& M) const;
  /// The upper triangle U with U^T U = metric.
  Eigen::MatrixXd root() const;

 private:
  Eigen::MatrixXd matrix_;
  bool isDiagonal_;
  Eigen::LLT<Eigen::MatrixXd> factors_;  // if not diagonal
};

}  // namespace rex::internal
