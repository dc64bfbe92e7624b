#include <fmt/format.h>

#include "base/error.h"
#include "kinematics/metric_internal.h"

namespace rex::internal {

Metric::Metric(const char* what, const Eigen::MatrixXd& given, Eigen::Index size)
    : matrix_(given.size() == 0 ? Eigen::MatrixXd::Identity(size, size) : given),
      isDiagonal_(matrix_.isDiagonal(0)) {
  if (matrix_.rows() != size || matrix_.cols() != size) {
    throw Error({.what = what,
                 .found = fmt::format("{} x {}", matrix_.rows(), matrix_.cols()),
                 .wanted = fmt::format("{} x {}, or empty for the identity", size, size)});
  }
  bool isPositive = matrix_.allFinite() && matrix_.isApprox(matrix_.transpose(), 1e-9);
  if (isDiagonal_) {
    isPositive = isPositive && (matrix_.diagonal().array() > 0).all();
  } else if (isPositive) {
    factors_.compute(matrix_);
    isPositive = factors_.info() == Eigen::Success;
  }
  if (!isPositive) throw Error({.what = what, .wanted = "a symmetric, positive definite matrix"});
}

Eigen::MatrixXd Metric::solve(const Eigen::MatrixXd& M) const {
  if (isDiagonal_) return matrix_.diagonal().cwiseInverse().asDiagonal() * M;
  return factors_.solve(M);
}

Eigen::MatrixXd Metric::root() const {
  if (isDiagonal_) return matrix_.diagonal().cwiseSqrt().asDiagonal();
  return factors_.matrixU();
}

}  // namespace rex::internal
