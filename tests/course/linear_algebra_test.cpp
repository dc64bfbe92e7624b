#include "course/linear_algebra.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex {
namespace {

Eigen::MatrixXd randomMatrix(Rng& rng, int rows, int cols) {
  return rng.normalVector(rows * cols).reshaped(rows, cols);
}

TEST(Inverse, UndoesItsMatrix) {
  Rng rng(1);
  for (int n = 0; n < 12; ++n) {
    const Eigen::MatrixXd A = randomMatrix(rng, n, n);
    EXPECT_TRUE((inverse(A) * A).isIdentity(1e-9)) << n;
  }
}

TEST(Solve, KeepsVectorsVectors) {
  Rng rng(2);
  const Eigen::MatrixXd A = randomMatrix(rng, 5, 5), B = randomMatrix(rng, 5, 3);
  const Eigen::VectorXd b = rng.normalVector(5);
  EXPECT_LT((A * solve(A, b) - b).norm(), 1e-10);
  EXPECT_LT((A * solve(A, B) - B).norm(), 1e-10);
  EXPECT_NEAR(b.dot(solve(A + A.transpose(), 2 * b)), 2 * b.dot(inverse(A + A.transpose()) * b), 1e-8);
}

TEST(LeastSquares, LeavesAResidualPerpendicularToTheColumns) {
  Rng rng(3);
  const Eigen::MatrixXd tall = randomMatrix(rng, 9, 4);
  const Eigen::VectorXd b = rng.normalVector(9);
  EXPECT_LT((tall.transpose() * (tall * leastSquares(tall, b) - b)).norm(), 1e-12);
}

TEST(LeastSquares, ChoosesTheShortestOfManySolutions) {
  Rng rng(4);
  const Eigen::MatrixXd wide = randomMatrix(rng, 3, 8);
  const Eigen::VectorXd b = rng.normalVector(3);
  const Eigen::VectorXd wanted = wide.transpose() * inverse(wide * wide.transpose()) * b;
  EXPECT_LT((leastSquares(wide, b) - wanted).norm(), 1e-10);
}

TEST(Eigenvalues, SolveTheCharacteristicEquation) {
  Eigen::VectorXcd values = eigenvalues((Eigen::MatrixXd(2, 2) << 0, 1, -4, 0).finished());
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
  EXPECT_NEAR(std::abs(values[0] - std::complex<double>(0, -2)), 0, 1e-12);
  EXPECT_NEAR(std::abs(values[1] - std::complex<double>(0, 2)), 0, 1e-12);
}

TEST(Svd, RebuildsItsMatrix) {
  Rng rng(5);
  const Eigen::MatrixXd A = randomMatrix(rng, 6, 4);
  const SingularValues parts = svd(A);
  EXPECT_LT((parts.U * parts.s.asDiagonal() * parts.V.transpose() - A).norm(), 1e-12);
  EXPECT_TRUE((parts.V.transpose() * parts.V).isIdentity(1e-12));
  EXPECT_TRUE(std::is_sorted(parts.s.begin(), parts.s.end(), std::greater<>()));
}

TEST(LinearAlgebra, RefusesWhatHasNoAnswer) {
  const Eigen::MatrixXd tall = Eigen::MatrixXd::Zero(3, 2), zero = Eigen::MatrixXd::Zero(3, 3);
  const Eigen::MatrixXd nan = Eigen::MatrixXd::Constant(2, 2, std::nan(""));
  EXPECT_REX_ERROR(inverse(tall), "inverse: found a 3 x 2 matrix, wanted a square matrix");
  EXPECT_REX_ERROR(inverse(zero),
                   "inverse: found a singular matrix (reciprocal condition 0.0e+00), wanted an invertible "
                   "one; leastSquares takes any");
  EXPECT_REX_ERROR(inverse(nan), "inverse: found nan or infinity, wanted finite numbers");
  EXPECT_REX_ERROR(solve(Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(2)),
                   "solve: found a right side with 2 rows, wanted 3");
  EXPECT_REX_ERROR(leastSquares(zero, Eigen::VectorXd::Zero(2)),
                   "leastSquares: found a right side with 2 rows, wanted 3");
  EXPECT_REX_ERROR(leastSquares(nan, Eigen::VectorXd::Zero(2)), "leastSquares: found nan or infinity");
  EXPECT_REX_ERROR(eigenvalues(tall), "eigenvalues: found a 3 x 2 matrix");
  EXPECT_REX_ERROR(svd(nan), "svd: found nan or infinity");
}

}  // namespace
}  // namespace rex
