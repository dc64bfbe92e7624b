#pragma once

#include <string>

#include <Eigen/Core>
#include <fmt/format.h>

#include "base/rng.h"
#include "course/linear_algebra.h"

// Random matrices for the problems of the checks.

inline Eigen::MatrixXd randomMatrix(rex::Rng& rng, int rows, int cols) {
  return rng.normalVector(rows * cols).reshaped(rows, cols);
}

// Redrawn until every correct way of solving with it, even through A^T A, keeps at least ten digits.
inline Eigen::MatrixXd wellConditioned(rex::Rng& rng, int rows, int cols) {
  for (;;) {
    Eigen::MatrixXd A = randomMatrix(rng, rows, cols);
    const Eigen::VectorXd s = rex::svd(A).s;
    if (s[0] < 50 * s[s.size() - 1]) return A;
  }
}

inline Eigen::MatrixXd positiveDefinite(rex::Rng& rng, int n) {
  const Eigen::MatrixXd G = randomMatrix(rng, n, n);
  return G * G.transpose() / n + 0.2 * Eigen::MatrixXd::Identity(n, n);
}

inline std::string sizes(const char* text, int rows, int cols) {
  return fmt::format("{}, {} x {}", text, rows, cols);
}
