#include "optim/linear_program.h"

#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::linear_program_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The least cost of all basic solutions, by trying every choice of columns.
std::optional<double> leastVertex(const MatrixXd& A, const VectorXd& b, const VectorXd& c) {
  std::optional<double> least;
  const int m = static_cast<int>(A.rows()), n = static_cast<int>(A.cols());
  for (unsigned chosen = 0; chosen < 1u << n; ++chosen) {
    if (__builtin_popcount(chosen) != m) continue;
    MatrixXd B(m, m);
    VectorXd cost(m);
    for (int j = 0, k = 0; j < n; ++j)
      if (chosen >> j & 1u) B.col(k) = A.col(j), cost[k++] = c[j];
    const Eigen::FullPivLU<MatrixXd> lu(B);
    if (!lu.isInvertible()) continue;
    const VectorXd x = lu.solve(b);
    if (x.minCoeff() >= -1e-9) least = std::min(least.value_or(HUGE_VAL), cost.dot(x));
  }
  return least;
}

void expectProven(const MatrixXd& A, const VectorXd& b, const VectorXd& c, const LinearSolution& s) {
  const double largest = 1 + s.x.cwiseAbs().maxCoeff() + s.y.cwiseAbs().maxCoeff();
  switch (s.status) {
    case LinearStatus::kOptimal:
      EXPECT_LT((A * s.x - b).cwiseAbs().maxCoeff(), 1e-8 * largest);
      EXPECT_GE(s.x.minCoeff(), 0);
      EXPECT_LT((A.transpose() * s.y - c).maxCoeff(), 1e-8 * largest);
      EXPECT_NEAR(b.dot(s.y), c.dot(s.x), 1e-8 * largest);
      break;
    case LinearStatus::kInfeasible:
      EXPECT_LT((A.transpose() * s.y).maxCoeff(), 1e-8 * largest);
      EXPECT_GT(b.dot(s.y), 1e-7 * largest);
      break;
    case LinearStatus::kUnbounded:
      EXPECT_LT((A * s.x).cwiseAbs().maxCoeff(), 1e-8 * largest);
      EXPECT_GE(s.x.minCoeff(), 0);
      EXPECT_LT(c.dot(s.x), -1e-7 * largest);
      break;
    case LinearStatus::kStalled:
      ADD_FAILURE() << "stalled";
  }
}

VectorXd wholeNumbers(Rng& rng, int size, int most) {
  return VectorXd::NullaryExpr(size, [&] { return rng.index(2 * most + 1) - most; });
}

TEST(LinearProgram, FindsTheBestVertexOrProvesThatThereIsNone) {
  Rng rng(11);
  int seen[4] = {};
  for (int trial = 0; trial < 3000; ++trial) {
    const int m = 1 + rng.index(4), n = m + rng.index(6);
    // Small whole numbers make programs that are degenerate, infeasible and unbounded.
    const MatrixXd A = wholeNumbers(rng, m * n, 2).reshaped(m, n);
    const VectorXd b = wholeNumbers(rng, m, 3), c = wholeNumbers(rng, n, 3);
    const LinearSolution solution = minimizeLinear(A, b, c);
    SCOPED_TRACE(trial);
    expectProven(A, b, c, solution);
    ++seen[static_cast<int>(solution.status)];
    if (solution.status == LinearStatus::kOptimal && Eigen::FullPivLU<MatrixXd>(A).rank() == m) {
      EXPECT_NEAR(solution.value, leastVertex(A, b, c).value(), 1e-8);
    }
  }
  EXPECT_GT(seen[0], 300);
  EXPECT_GT(seen[1], 300);
  EXPECT_GT(seen[2], 300);
}

TEST(LinearProgram, HoldsForColumnsAndRowsOfAllSizes) {
  Rng rng(5);
  for (int trial = 0; trial < 300; ++trial) {
    const int m = 6, n = 60;
    MatrixXd A = rng.normalVector(m * n).reshaped(m, n);
    for (int i = 0; i < m; ++i) A.row(i) *= std::pow(10, rng.uniform(-3, 3));
    const VectorXd x = rng.uniformVector(n, 0, 1), y = rng.normalVector(m);
    const VectorXd b = A * x,
                   c = A.transpose() * y + rng.uniformVector(n, 0, 1);  // so both sides have points
    const LinearSolution s = minimizeLinear(A, b, c);
    ASSERT_EQ(s.status, LinearStatus::kOptimal) << trial;
    EXPECT_LT(((A * s.x - b).cwiseAbs().cwiseQuotient(b.cwiseAbs())).maxCoeff(), 1e-8);
    EXPECT_NEAR(b.dot(s.y), s.value, 1e-8 * (1 + std::abs(s.value)));
    EXPECT_LE(s.value, c.dot(x));
  }
}

TEST(LinearProgram, LeavesBealesCycle) {
  MatrixXd A(3, 7);
  A << 1, 0, 0, .25, -60, -.04, 9,  //
      0, 1, 0, .5, -90, -.02, 3,    //
      0, 0, 1, 0, 0, 1, 0;
  VectorXd c(7);
  c << 0, 0, 0, -.75, 150, -.02, 6;
  const LinearSolution s = minimizeLinear(A, Eigen::Vector3d(0, 0, 1), c);
  EXPECT_EQ(s.status, LinearStatus::kOptimal);
  EXPECT_NEAR(s.value, -0.05, 1e-12);
}

TEST(LinearProgram, TakesRowsTwiceAndColumnsOfZeros) {
  MatrixXd A(3, 4);
  A << 1, 1, 0, 0,  //
      2, 2, 0, 0,   //
      1, 0, 0, 1;
  const VectorXd c = Eigen::Vector4d(1, 2, 0, -1);
  const LinearSolution s = minimizeLinear(A, Eigen::Vector3d(1, 2, 3), c);
  ASSERT_EQ(s.status, LinearStatus::kOptimal);
  EXPECT_NEAR(s.value, -1, 1e-12);  // x = (1, 0, ., 2), or (0, 1, ., 3)
  const LinearSolution none = minimizeLinear(A, Eigen::Vector3d(1, 3, 3), c);
  EXPECT_EQ(none.status, LinearStatus::kInfeasible);
  expectProven(A, Eigen::Vector3d(1, 3, 3), c, none);
  EXPECT_EQ(minimizeLinear(A, Eigen::Vector3d(1, 2, 3), Eigen::Vector4d(1, 1, -1, 0)).status,
            LinearStatus::kUnbounded);
}

TEST(LinearProgram, WithoutColumnsOnlyZeroIsReached) {
  const MatrixXd A(2, 0);
  EXPECT_EQ(minimizeLinear(A, Eigen::Vector2d(0, 0), VectorXd()).status, LinearStatus::kOptimal);
  const LinearSolution none = minimizeLinear(A, Eigen::Vector2d(0, -1), VectorXd());
  EXPECT_EQ(none.status, LinearStatus::kInfeasible);
  EXPECT_GT(Eigen::Vector2d(0, -1).dot(none.y), 0);
}

TEST(LinearProgram, RefusesWhatIsNoProgram) {
  const MatrixXd A = MatrixXd::Ones(2, 3);
  const VectorXd b = VectorXd::Ones(2), c = VectorXd::Ones(3);
  MatrixXd broken = A;
  broken(1, 2) = std::nan("");
  EXPECT_REX_ERROR(minimizeLinear(A, c, c), "linear program: b: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(minimizeLinear(A, b, b), "linear program: c: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(minimizeLinear(MatrixXd(0, 3), VectorXd(), c), "linear program: found no rows");
  EXPECT_REX_ERROR(minimizeLinear(broken, b, c), "linear program: A: number 1: found nan");
  EXPECT_REX_ERROR(minimizeLinear(A, b * HUGE_VAL, c), "linear program: b: number 0: found inf");
  EXPECT_REX_ERROR(minimizeLinear(A, b, c * HUGE_VAL), "linear program: c: number 0: found inf");
}

}  // namespace rex::linear_program_test
