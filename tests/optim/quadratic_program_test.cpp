#include "optim/quadratic_program.h"

#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"
#include "support/quadratic_peer.h"

namespace rex::quadratic_program_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Program {
  MatrixXd H, A;
  VectorXd g, lower, upper;

  QuadraticSolution minimized(const std::vector<int>& guess = {}) const {
    return QuadraticProgram(H, A).minimize(g, lower, upper, guess);
  }
};

VectorXd wholeNumbers(Rng& rng, int size, int most) {
  return VectorXd::NullaryExpr(size, [&] { return rng.index(2 * most + 1) - most; });
}

MatrixXd positive(Rng& rng, int n) {
  const MatrixXd root = rng.normalVector(n * n).reshaped(n, n);
  return root * root.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

// Whole numbers make bounds that meet in one point, equations, and programs without a point.
Program smallProgram(Rng& rng) {
  const int n = 1 + rng.index(4), m = rng.index(6);
  Program p{.H = positive(rng, n),
            .A = wholeNumbers(rng, m * n, 2).reshaped(m, n),
            .g = wholeNumbers(rng, n, 4),
            .lower = wholeNumbers(rng, m, 3),
            .upper = {}};
  p.upper = p.lower + wholeNumbers(rng, m, 2).cwiseAbs();
  for (int i = 0; i < m; ++i) {
    const int kind = rng.index(4);
    if (kind == 0) p.lower[i] = -kInfinite;
    if (kind == 1) p.upper[i] = kInfinite;
  }
  return p;
}

// The best of all points at which some rows hold with equality, by trying every choice: 0, at the lower or at
// the upper bound.
std::optional<double> leastByTrying(const Program& p) {
  const int n = static_cast<int>(p.g.size()), m = static_cast<int>(p.lower.size());
  std::optional<double> least;
  for (int code = 0; code < std::pow(3, m); ++code) {
    std::vector<int> rows;
    std::vector<double> bounds;
    for (int i = 0, rest = code; i < m; ++i, rest /= 3) {
      if (rest % 3 == 0) continue;
      rows.push_back(i);
      bounds.push_back(rest % 3 == 1 ? p.lower[i] : p.upper[i]);
    }
    const int q = static_cast<int>(rows.size());
    if (q > n) continue;
    MatrixXd kkt = MatrixXd::Zero(n + q, n + q);
    VectorXd right(n + q);
    kkt.topLeftCorner(n, n) = p.H;
    right.head(n) = -p.g;
    for (int k = 0; k < q; ++k) {
      kkt.block(n + k, 0, 1, n) = p.A.row(rows[static_cast<std::size_t>(k)]);
      right[n + k] = bounds[static_cast<std::size_t>(k)];
    }
    kkt.topRightCorner(n, q) = kkt.bottomLeftCorner(q, n).transpose();
    if (!right.allFinite()) continue;
    const Eigen::FullPivLU<MatrixXd> lu(kkt);
    if (!lu.isInvertible()) continue;
    const VectorXd x = lu.solve(right).head(n), Ax = p.A * x;
    if (((p.lower - Ax).array() > 1e-9).any() || ((Ax - p.upper).array() > 1e-9).any()) continue;
    least = std::min(least.value_or(HUGE_VAL), x.dot(p.H * x / 2 + p.g));
  }
  return least;
}

// Substitutes the solution, without looking at what it says of its own residual.
void expectProven(const Program& p, const QuadraticSolution& s) {
  ASSERT_NE(s.status, QuadraticStatus::kStalled);
  const double size = 1 + s.y.cwiseAbs().sum();
  if (s.status == QuadraticStatus::kInfeasible) {
    EXPECT_LT((p.A.transpose() * s.y).norm(), 1e-9 * size);
    double demanded = 0;
    for (int i = 0; i < s.y.size(); ++i)
      if (s.y[i] != 0) demanded += s.y[i] * (s.y[i] > 0 ? p.lower[i] : p.upper[i]);
    EXPECT_GT(demanded, 1e-9 * size);
    return;
  }
  EXPECT_LT((p.H * s.x + p.g - p.A.transpose() * s.y).norm(), 1e-9 * size * (1 + p.g.norm()));
  for (int i = 0; i < s.y.size(); ++i) {
    const double value = p.A.row(i).dot(s.x);
    EXPECT_GT(value, p.lower[i] - 1e-9);
    EXPECT_LT(value, p.upper[i] + 1e-9);
    if (s.y[i] != 0) {
      EXPECT_NEAR(value, s.y[i] > 0 ? p.lower[i] : p.upper[i], 1e-9);
    }
  }
}

TEST(QuadraticProgram, FindsTheMinimumOrProvesThatThereIsNoPoint) {
  Rng rng(7);
  int optimal = 0, infeasible = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const Program p = smallProgram(rng);
    const QuadraticSolution s = p.minimized();
    expectProven(p, s);
    const std::optional<double> least = leastByTrying(p);
    ASSERT_EQ(s.status == QuadraticStatus::kOptimal, least.has_value());
    if (!least) {
      ++infeasible;
      continue;
    }
    ++optimal;
    EXPECT_NEAR(s.value, *least, 1e-8 * (1 + std::abs(*least)));
    EXPECT_LT(s.residual, 1e-9);
  }
  EXPECT_GT(optimal, 1000);
  EXPECT_GT(infeasible, 200);
}

// A box, a band and equations between 60 variables, as in control.
Program largeProgram(Rng& rng) {
  const int n = 60, m = 100;
  Program p{.H = positive(rng, n),
            .A = rng.normalVector(m * n).reshaped(m, n),
            .g = 20 * rng.normalVector(n),
            .lower = VectorXd::Constant(m, -1),
            .upper = VectorXd::Constant(m, 1)};
  p.A.topRows(n).setIdentity();
  p.lower.tail(40).setConstant(-kInfinite);
  p.lower.tail(5) = p.upper.tail(5) = VectorXd::Constant(5, 0.1);
  return p;
}

TEST(QuadraticProgram, AGuessChangesTheWorkOnly) {
  Rng rng(3);
  int fromNothing = 0, fromTheLast = 0;
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Program p = largeProgram(rng);
    const QuadraticSolution cold = p.minimized();
    ASSERT_EQ(cold.status, QuadraticStatus::kOptimal);
    expectProven(p, cold);
    const QuadraticSolution again = p.minimized(cold.active);
    fromNothing += cold.iterations, fromTheLast += again.iterations;
    EXPECT_LT((again.x - cold.x).norm(), 1e-9);
    std::vector<int> useless;
    for (int i = 0; i < 30; ++i) useless.push_back(rng.index(100));
    EXPECT_LT((p.minimized(useless).x - cold.x).norm(), 1e-9);
  }
  EXPECT_LT(fromTheLast, 0.95 * fromNothing);
}

TEST(QuadraticProgram, HoldsForRowsAndVariablesOfAllSizes) {
  Rng rng(4);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    Program p = largeProgram(rng);
    const double value = p.minimized().value;
    for (int i = 0; i < p.lower.size(); ++i) {
      const double factor = std::pow(10, rng.uniform(-4, 4));
      p.A.row(i) *= factor, p.lower[i] *= factor, p.upper[i] *= factor;
    }
    EXPECT_NEAR(p.minimized().value, value, 1e-8 * std::abs(value));
    const VectorXd unit = VectorXd::NullaryExpr(60, [&] { return std::pow(10, rng.uniform(-2, 2)); });
    p.H = (unit.asDiagonal() * p.H * unit.asDiagonal()).eval();
    p.A = (p.A * unit.asDiagonal()).eval();
    p.g = p.g.cwiseProduct(unit).eval();
    const QuadraticSolution s = p.minimized();
    EXPECT_NEAR(s.value, value, 1e-7 * std::abs(value));
    EXPECT_LT(s.residual, 1e-7);
  }
}

TEST(QuadraticProgram, AgreesWithAPackagedSolver) {
  REX_NEEDS_CVXOPT();
  Rng rng(9);
  QuadraticPeer peer;
  std::vector<Program> programs;
  for (int i = 0; i < 20; ++i) {
    const Program& p = programs.emplace_back(largeProgram(rng));
    peer.add(p.H, p.g, p.A, p.lower, p.upper);
  }
  const std::vector<QuadraticPeer::Minimum> theirs = peer.minima();
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const QuadraticSolution ours = programs[i].minimized();
    EXPECT_NEAR(ours.value, theirs[i].value, 1e-7 * (1 + std::abs(theirs[i].value)));
    EXPECT_LT((ours.x - theirs[i].x).norm(), 1e-3);  // theirs stops short of the corners
  }
}

TEST(QuadraticProgram, TakesRowsTwiceRowsOfZerosAndNoRows) {
  Program p{.H = MatrixXd::Identity(2, 2),
            .A = MatrixXd::Zero(4, 2),
            .g = Eigen::Vector2d(-4, 0),
            .lower = Eigen::Vector4d(-kInfinite, -1, 1, 1),
            .upper = Eigen::Vector4d(2, 0, 1, 1)};
  p.A << 1, 0, 0, 0, 1, 1, 1, 1;  // x <= 2, nothing, and x + y = 1 twice
  const QuadraticSolution s = p.minimized();
  ASSERT_EQ(s.status, QuadraticStatus::kOptimal);
  EXPECT_LT((s.x - Eigen::Vector2d(2, -1)).norm(), 1e-12);
  p.upper[3] = p.lower[3] = 2;
  EXPECT_EQ(p.minimized().status, QuadraticStatus::kInfeasible);
  expectProven(p, p.minimized());
  p.lower[3] = p.upper[3] = 1, p.lower[1] = p.upper[1] = 1;  // 0 = 1
  EXPECT_EQ(p.minimized().status, QuadraticStatus::kInfeasible);
  const QuadraticSolution free = QuadraticProgram(p.H, MatrixXd(0, 2)).minimize(p.g, VectorXd(), VectorXd());
  EXPECT_LT((free.x - Eigen::Vector2d(4, 0)).norm(), 1e-12);
}

TEST(QuadraticProgram, RefusesWhatIsNoProgram) {
  const MatrixXd H = MatrixXd::Identity(3, 3), A = MatrixXd::Ones(2, 3);
  const VectorXd three = VectorXd::Ones(3), two = VectorXd::Ones(2);
  MatrixXd broken = A;
  broken(1, 2) = std::nan("");
  EXPECT_REX_ERROR(QuadraticProgram(A, A),
                   "quadratic program: columns of H: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(QuadraticProgram(H, MatrixXd::Ones(1, 2)),
                   "quadratic program: columns of A: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(QuadraticProgram(H * HUGE_VAL, A), "quadratic program: H: number 0: found inf");
  EXPECT_REX_ERROR(QuadraticProgram(H, broken), "quadratic program: A: number 1: found nan");
  EXPECT_REX_ERROR(QuadraticProgram(-H, A), "quadratic program: found an H that is not positive definite");
  const QuadraticProgram program(H, A);
  EXPECT_REX_ERROR((void)program.minimize(two, two, two),
                   "quadratic program: g: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR((void)program.minimize(three, three, two),
                   "quadratic program: lower: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR((void)program.minimize(three, two, three),
                   "quadratic program: upper: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR((void)program.minimize(three * std::nan(""), two, two),
                   "quadratic program: g: number 0: found nan");
  EXPECT_REX_ERROR((void)program.minimize(three, 2 * two, two),
                   "quadratic program: row 0: found bounds 2 and 1, wanted lower <= upper");
  EXPECT_REX_ERROR((void)program.minimize(three, two * HUGE_VAL, two * HUGE_VAL),
                   "quadratic program: row 0: found bounds inf and inf, wanted lower <= upper");
  EXPECT_REX_ERROR((void)program.minimize(three, two, two, {2}),
                   "quadratic program: guess: found row 2, wanted one of 2 rows");
}

}  // namespace rex::quadratic_program_test
