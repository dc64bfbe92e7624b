#pragma once

#include "base/rng.h"
#include "estimation/gaussian.h"

namespace rex::test {

inline Eigen::MatrixXd randomMatrix(int rows, int cols, Rng& rng) {
  Eigen::MatrixXd M(rows, cols);
  for (int j = 0; j < cols; ++j) M.col(j) = rng.normalVector(rows);
  return M;
}

/// Positive definite, of a moderate condition.
inline Eigen::MatrixXd randomCovariance(int n, Rng& rng) {
  const Eigen::MatrixXd M = randomMatrix(n, n, rng);
  return M * M.transpose() / n + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

inline Gaussian randomGaussian(int n, Rng& rng) { return {rng.normalVector(n), randomCovariance(n, rng)}; }

inline LinearModel randomModel(int rows, int n, Rng& rng) {
  return {randomMatrix(rows, n, rng), rng.normalVector(rows), randomCovariance(rows, rng)};
}

}  // namespace rex::test
