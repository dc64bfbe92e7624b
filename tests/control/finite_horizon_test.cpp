#include "control/finite_horizon.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::finite_horizon_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

struct Problem {
  LinearSystem system;
  MatrixXd Q, R, F;
};

Problem randomProblem(Rng& rng) {
  const MatrixXd C = rng.normalVector(9).reshaped(3, 3);
  return {{.A = rng.normalVector(9).reshaped(3, 3), .B = rng.normalVector(6).reshaped(3, 2)},
          C * C.transpose(),
          Eigen::Vector2d(0.5, 2).asDiagonal(),
          3 * MatrixXd::Identity(3, 3)};
}

// All states and controls of the horizon as one system of linear equations.
TEST(DiscreteHorizon, IsTheBestOfAllControls) {
  Rng rng(21);
  for (int round = 0; round < 10; ++round) {
    Problem p = randomProblem(rng);
    p.system.step = 1;
    constexpr int kSteps = 5;
    const RiccatiHorizon horizon = discreteHorizon(p.system, p.Q, p.R, p.F, kSteps);
    ASSERT_TRUE(horizon.isSolved);
    ASSERT_EQ(horizon.P.size(), kSteps + 1u);
    ASSERT_EQ(horizon.K.size(), static_cast<std::size_t>(kSteps));
    const VectorXd start = rng.normalVector(3);
    MatrixXd free = start, reach = MatrixXd::Zero(3, 2 * kSteps), H = MatrixXd::Zero(2 * kSteps, 2 * kSteps);
    VectorXd h = VectorXd::Zero(2 * kSteps);
    double constant = start.dot(p.Q * start);
    for (int t = 0; t < kSteps; ++t) {
      H.block(2 * t, 2 * t, 2, 2) += p.R;
      free = (p.system.A * free).eval();
      reach = (p.system.A * reach).eval();
      reach.middleCols(2 * t, 2) = p.system.B;
      const MatrixXd& weight = t + 1 < kSteps ? p.Q : p.F;
      H += reach.transpose() * weight * reach;
      h += reach.transpose() * weight * free;
      constant += (free.transpose() * weight * free).trace();
    }
    const VectorXd best = -H.ldlt().solve(h);
    EXPECT_NEAR(start.dot(horizon.P[0] * start), constant + h.dot(best), 1e-8 * constant);
    VectorXd x = start;
    for (int t = 0; t < kSteps; ++t) {
      const VectorXd u = -horizon.K[static_cast<std::size_t>(t)] * x;
      EXPECT_LT((u - best.segment(2 * t, 2)).norm(), 1e-7 * (1 + best.norm()));
      x = (p.system.A * x + p.system.B * u).eval();
    }
  }
}

// Against Runge and Kutta's steps of the differential equation.
TEST(ContinuousHorizon, SolvesTheDifferentialEquation) {
  Rng rng(22);
  const Problem p = randomProblem(rng);
  const double T = 0.8;
  const RiccatiHorizon horizon = continuousHorizon(p.system, p.Q, p.R, p.F, T, 4);
  ASSERT_TRUE(horizon.isSolved) << horizon.message;
  const MatrixXd G = p.system.B * p.R.inverse() * p.system.B.transpose();
  const auto rate = [&](const MatrixXd& P) -> MatrixXd {
    return p.system.A.transpose() * P + P * p.system.A - P * G * P + p.Q;
  };
  MatrixXd P = p.F;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    if (i % (kSteps / 4) == 0) {
      const auto k = static_cast<std::size_t>(4 - i / (kSteps / 4));
      EXPECT_LT((horizon.P[k] - P).norm(), 1e-9 * P.norm()) << k;
      EXPECT_LT((horizon.K[k] - p.R.inverse() * p.system.B.transpose() * P).norm(), 1e-8 * P.norm());
    }
    const double h = T / kSteps;
    const MatrixXd k1 = rate(P), k2 = rate(P + h / 2 * k1), k3 = rate(P + h / 2 * k2), k4 = rate(P + h * k3);
    P += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_LT((horizon.P[0] - P).norm(), 1e-9 * P.norm());
}

// Far from the end, the gains are those of the algebraic equations, also across 100 s at once.
TEST(Horizon, ConvergesToTheAlgebraicEquation) {
  Rng rng(23);
  Problem p = randomProblem(rng);
  const MatrixXd X = solveCare(p.system.A, p.system.B, p.Q, p.R).X;
  const RiccatiHorizon continuous = continuousHorizon(p.system, p.Q, p.R, p.F, 100, 1);
  ASSERT_TRUE(continuous.isSolved) << continuous.message;
  EXPECT_LT((continuous.P[0] - X).norm(), 1e-10 * X.norm());
  p.system.step = 1;
  const MatrixXd Y = solveDare(p.system.A, p.system.B, p.Q, p.R).X;
  EXPECT_LT((discreteHorizon(p.system, p.Q, p.R, p.F, 500).P[0] - Y).norm(), 1e-10 * Y.norm());
}

// P' = -P^2 - 1 backward is the tangent: it has left the reals at pi / 2. And a control that earns.
TEST(Horizon, SaysWherePGrowsWithoutBound) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  LinearSystem system{.A = 0 * one, .B = one};
  const RiccatiHorizon before = continuousHorizon(system, -one, one, 0 * one, 1.5, 3);
  ASSERT_TRUE(before.isSolved);
  EXPECT_NEAR(before.P[0](0, 0), -std::tan(1.5), 1e-11);
  const RiccatiHorizon after = continuousHorizon(system, -one, one, 0 * one, 2, 1);
  EXPECT_FALSE(after.isSolved);
  EXPECT_TRUE(after.P.empty());
  EXPECT_THAT(after.message, HasSubstr("P grows without bound before time 2"));
  // Two at once: a determinant would have changed its sign twice.
  const MatrixXd two = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(continuousHorizon({.A = 0 * two, .B = two}, -two, two, 0 * two, 2, 1).isSolved);
  // A cheap control is fast, yet P = tanh(t / sqrt(R)) sqrt(R) is soon found.
  for (const double cheap : {1e-6, 1e-10, 1e-14})
    EXPECT_NEAR(continuousHorizon(system, one, cheap * one, 0 * one, 1e-6, 1).P[0](0, 0) / std::sqrt(cheap),
                std::tanh(1e-6 / std::sqrt(cheap)), 1e-9);
  const RiccatiHorizon endless = continuousHorizon({.A = 1e12 * one, .B = one}, one, one, one, 1, 1);
  EXPECT_FALSE(endless.isSolved);
  EXPECT_THAT(endless.message,
              HasSubstr("time T is too long for the fastest motion: it takes 2.8e+12 parts"));
  // A steep end is not an end.
  EXPECT_NEAR(continuousHorizon(system, 0 * one, one, 1e12 * one, 2, 1).P[0](0, 0), 0.5, 1e-11);
  system.step = 1;
  const RiccatiHorizon earning = discreteHorizon(system, one, one, -3 * one, 4);
  EXPECT_FALSE(earning.isSolved);
  EXPECT_THAT(earning.message, HasSubstr("step 3: R + B^T P B is not positive definite"));
  system.A = 1e200 * one;
  EXPECT_THAT(discreteHorizon(system, 0 * one, 1e150 * one, 1e-10 * one, 4).message,
              HasSubstr("P is not finite"));
}

// Exercise 11b: epsilon = 1/1000 from P = Q, with the cart pole of erratum 32: about 29 000 iterations.
TEST(IterateCare, FindsTheGainsOfTheCartPole) {
  LinearSystem system{.A = MatrixXd::Zero(4, 4), .B = MatrixXd::Zero(4, 1)};
  system.A(0, 1) = system.A(2, 3) = 1;
  system.A(1, 2) = -5.88;
  system.A(3, 2) = 11.76;
  system.B(1, 0) = 0.8;
  system.B(3, 0) = -0.6;
  const MatrixXd Q = Eigen::Vector4d(1, 0, 1, 0).asDiagonal(), R = MatrixXd::Identity(1, 1);
  const RiccatiIteration slow = iterateCare(system, Q, R, {.tolerance = 1e-7});
  ASSERT_TRUE(slow.isConverged) << slow.message;
  EXPECT_NEAR(slow.iterations, 29000, 9000);
  const RiccatiResult exact = solveCare(system.A, system.B, Q, R);
  EXPECT_LT((slow.P - exact.X).norm(), 1e-6 * exact.X.norm());
  EXPECT_LT((slow.K - exact.K).norm(), 1e-6 * exact.K.norm());
  EXPECT_FALSE(iterateCare(system, Q, R, {.maxIterations = 100}).isConverged);
  EXPECT_THAT(iterateCare(system, Q, R, {.maxIterations = 100}).message,
              HasSubstr("iteration limit reached after 100"));
  const RiccatiIteration wild = iterateCare(system, Q, R, {.epsilon = 1});
  EXPECT_FALSE(wild.isConverged);
  EXPECT_THAT(wild.message, HasSubstr("P grows without bound"));
}

TEST(Horizon, SaysWhatIsWrong) {
  const MatrixXd one = MatrixXd::Identity(1, 1), two = MatrixXd::Identity(2, 2);
  const LinearSystem system{.A = one, .B = one};
  LinearSystem steps = system;
  steps.step = 1;
  EXPECT_REX_ERROR(discreteHorizon(system, one, one, one, 3), "found continuous time, wanted discrete time");
  EXPECT_REX_ERROR(continuousHorizon(steps, one, one, one, 3, 3),
                   "found discrete time, wanted continuous time");
  EXPECT_REX_ERROR(discreteHorizon(steps, one, one, one, 0),
                   "steps of a horizon: found 0, wanted 1 to 10000000");
  EXPECT_REX_ERROR(continuousHorizon(system, one, one, one, 0, 3), "time T of a horizon: found 0");
  EXPECT_REX_ERROR(discreteHorizon(steps, two, one, one, 3),
                   "rows of Q: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR(discreteHorizon(steps, one, one, MatrixXd::Zero(1, 2), 3),
                   "columns of F: found a vector of size 2");
  EXPECT_REX_ERROR(discreteHorizon(steps, one, one, NAN * one, 3),
                   "matrix F: found entries that are not finite");
  EXPECT_REX_ERROR(continuousHorizon(system, one, 0 * one, one, 1, 3),
                   "matrix R: found the eigenvalue 0, wanted a positive definite matrix");
  const LinearSystem idle{.A = one, .B = MatrixXd(1, 0)};
  EXPECT_REX_ERROR(continuousHorizon(idle, one, MatrixXd(0, 0), one, 1, 3),
                   "linear system: found no control");
  MatrixXd skewed = two;
  skewed(0, 1) = 1;
  EXPECT_REX_ERROR(iterateCare({.A = two, .B = two}, skewed, two),
                   "matrix Q: found a matrix that is not symmetric");
  EXPECT_REX_ERROR(iterateCare(system, one, one, {.epsilon = 0}), "epsilon of the iteration: found 0");
  EXPECT_REX_ERROR(iterateCare(system, one, one, {.tolerance = -1}), "tolerance of the iteration: found -1");
  EXPECT_REX_ERROR(iterateCare(system, one, one, {.maxIterations = 0}),
                   "iterations: found 0, wanted at least 1");
}

}  // namespace rex::finite_horizon_test
