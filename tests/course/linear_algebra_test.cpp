#include "course/linear_algebra.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::linear_algebra_test {

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
  const Eigen::MatrixXd pseudoInverse = wide.transpose() * inverse(wide * wide.transpose());
  EXPECT_LT((leastSquares(wide, b) - pseudoInverse * b).norm(), 1e-10);
  EXPECT_LT((leastSquares(wide, Eigen::MatrixXd::Identity(3, 3)) - pseudoInverse).norm(), 1e-10);
  EXPECT_NEAR(wide.row(0).dot(leastSquares(wide, 2 * b)), 2 * b(0), 1e-10) << "an expression of a vector";
}

TEST(LeastSquares, HoldsForEverySizeOfNumbersAndOfMatrices) {
  for (const double size : {1e-200, 1., 1e200}) {
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Constant(3, 2, size);
    EXPECT_LT((leastSquares(ones, Eigen::Vector3d(1, 2, 3)) * size - Eigen::Vector2d(1, 1)).norm(), 1e-14);
  }
  EXPECT_EQ(leastSquares(Eigen::MatrixXd(3, 0), Eigen::Vector3d::Ones()).size(), 0);
  EXPECT_EQ(leastSquares(Eigen::MatrixXd(0, 0), Eigen::VectorXd()).size(), 0);
  EXPECT_EQ(leastSquares(Eigen::MatrixXd(0, 3), Eigen::VectorXd()), Eigen::Vector3d::Zero());
  EXPECT_EQ(leastSquares(Eigen::MatrixXd::Zero(2, 3), Eigen::Vector2d::Ones()), Eigen::Vector3d::Zero());
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

TEST(Svd, TakesEmptyMatrices) {
  for (const auto& [rows, cols] : {std::pair{0, 0}, {3, 0}, {0, 3}}) {
    const SingularValues parts = svd(Eigen::MatrixXd(rows, cols));
    EXPECT_EQ(parts.U.rows(), rows);
    EXPECT_EQ(parts.V.rows(), cols);
    EXPECT_EQ(parts.U.cols() + parts.s.size() + parts.V.cols(), 0);
  }
  EXPECT_EQ(eigenvalues(Eigen::MatrixXd(0, 0)).size(), 0);
}

TEST(SolveSparse, AgreesWithTheDenseSolver) {
  Rng rng(6);
  for (const int n : {0, 1, 30}) {
    Eigen::MatrixXd H = 1e-3 * Eigen::MatrixXd::Identity(n, n);
    std::vector<MatrixEntry> entries;
    for (int i = 0; i < n; ++i) entries.push_back({i, i, 1e-3});
    for (int k = 0; k + 1 < n; ++k) {  // entries of neighbours, added up in parts
      const Eigen::Vector2d a = rng.normalVector(2);
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
          entries.push_back({k + r, k + c, a[r] * a[c]});
          H(k + r, k + c) += a[r] * a[c];
        }
    }
    const Eigen::VectorXd b = rng.normalVector(n);
    const Eigen::VectorXd x = solveSparse(entries, b);
    EXPECT_LT((H * x - b).norm(), 1e-9 * (1 + x.norm()));
    if (n > 0) {
      EXPECT_LT((x - solve(H, b)).norm(), 1e-9 * (1 + x.norm()));
    }
  }
}

// Numbers of any size, and unknowns in different units.
TEST(SolveSparse, DoesNotMindUnits) {
  for (const double size : {1e-200, 1., 1e200}) {
    const Eigen::Vector2d x = solveSparse({{0, 0, size}, {1, 1, 1e-18 * size}}, Eigen::Vector2d(size, size));
    EXPECT_DOUBLE_EQ(x[0], 1);
    EXPECT_DOUBLE_EQ(x[1], 1e18);
    EXPECT_REX_ERROR(solveSparse({{0, 0, size}, {1, 1, size}, {0, 1, .5 * size}}, Eigen::Vector2d(1, 1)),
                     "not symmetric");
    EXPECT_REX_ERROR(
        solveSparse({{0, 0, size}, {1, 1, size}, {0, 1, size}, {1, 0, size}}, Eigen::Vector2d(1, 1)),
        "singular");
  }
}

TEST(SolveSparse, RefusesWhatHasNoAnswer) {
  const Eigen::Vector2d b(1, 2);
  EXPECT_REX_ERROR(solveSparse({{0, 0, 1}}, b), "singular, or not positive definite");
  EXPECT_REX_ERROR(solveSparse({{0, 0, 1}, {1, 1, 1}, {0, 1, 1}, {1, 0, 1}}, b), "singular");
  EXPECT_REX_ERROR(solveSparse({{0, 0, 1}, {1, 1, -1}}, b), "not positive definite");
  EXPECT_REX_ERROR(solveSparse({{0, 0, 1}, {1, 1, 1}, {0, 1, .5}}, b), "not symmetric");
  EXPECT_REX_ERROR(solveSparse({{0, 2, 1}}, b), "solveSparse: entry (0, 2): found 1, wanted a finite number");
  EXPECT_REX_ERROR(solveSparse({{1, 1, std::nan("")}}, b), "solveSparse: entry (1, 1): found nan");
  EXPECT_REX_ERROR(solveSparse({{0, 0, 1}, {1, 1, 1}}, Eigen::Vector2d(0, std::nan(""))),
                   "solveSparse: found nan");
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
  EXPECT_REX_ERROR(solve(Eigen::MatrixXd::Identity(2, 2), nan), "solve: right side: found nan or infinity");
  EXPECT_REX_ERROR(leastSquares(Eigen::MatrixXd::Identity(2, 2), nan.col(0)),
                   "leastSquares: right side: found nan or infinity");
  EXPECT_REX_ERROR(eigenvalues(nan), "eigenvalues: found nan or infinity");
  EXPECT_REX_ERROR(eigenvalues(tall), "eigenvalues: found a 3 x 2 matrix");
  EXPECT_REX_ERROR(svd(nan), "svd: found nan or infinity");
}

}  // namespace rex::linear_algebra_test
