#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/finite_horizon.h"
#include "support/expect_error.h"

namespace rex::lq_tracking_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

// A cost with all terms that has a minimum: (x; u)^T J^T J (x; u) + 2 (q; r)^T (x; u).
LqStage randomStage(Rng& rng) {
  const MatrixXd J = randomMatrix(6, 5, rng);
  const MatrixXd H = J.transpose() * J + 0.1 * MatrixXd::Identity(5, 5);
  return {.A = randomMatrix(3, 3, rng),
          .B = randomMatrix(3, 2, rng),
          .c = rng.normalVector(3),
          .Q = H.topLeftCorner(3, 3),
          .R = H.bottomRightCorner(2, 2),
          .S = H.bottomLeftCorner(2, 3),
          .q = rng.normalVector(3),
          .r = rng.normalVector(2)};
}

double costOf(const std::vector<LqStage>& stages, const MatrixXd& F, const VectorXd& f, VectorXd x,
              const VectorXd& controls) {
  double cost = 0;
  for (std::size_t t = 0; t < stages.size(); ++t) {
    const LqStage& s = stages[t];
    const VectorXd u = controls.segment(2 * static_cast<Eigen::Index>(t), 2);
    cost += x.dot(s.Q * x) + u.dot(s.R * u) + 2 * u.dot(s.S * x) + 2 * s.q.dot(x) + 2 * s.r.dot(u);
    x = (s.A * x + s.B * u + s.c).eval();
  }
  return cost + x.dot(F * x) + 2 * f.dot(x);
}

VectorXd controlsOf(const std::vector<LqStage>& stages, const LqPolicy& policy, VectorXd x) {
  VectorXd controls(2 * static_cast<Eigen::Index>(stages.size()));
  for (std::size_t t = 0; t < stages.size(); ++t) {
    const VectorXd u = policy.k[t] - policy.K[t] * x;
    controls.segment(2 * static_cast<Eigen::Index>(t), 2) = u;
    x = (stages[t].A * x + stages[t].B * u + stages[t].c).eval();
  }
  return controls;
}

// The cost is quadratic in all controls: its matrix by evaluating it, its minimum by one linear system.
TEST(SolveLq, FindsTheBestControls) {
  Rng rng(31);
  for (int round = 0; round < 10; ++round) {
    std::vector<LqStage> stages;
    for (int t = 0; t < 4; ++t) stages.push_back(randomStage(rng));
    const MatrixXd F = MatrixXd::Identity(3, 3);
    const VectorXd f = rng.normalVector(3), start = rng.normalVector(3);
    const auto cost = [&](const VectorXd& u) { return costOf(stages, F, f, start, u); };
    const MatrixXd I = MatrixXd::Identity(8, 8);
    const double none = cost(VectorXd::Zero(8));
    VectorXd slope(8);
    MatrixXd H(8, 8);
    for (int i = 0; i < 8; ++i) slope[i] = (cost(I.col(i)) - cost(-I.col(i))) / 2;
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 8; ++k)
        H(i, k) = (cost(I.col(i) + I.col(k)) - cost(I.col(i)) - cost(I.col(k)) + none) / 2;
    const VectorXd best = -0.5 * H.ldlt().solve(slope);
    const LqPolicy policy = solveLq(stages, F, f);
    ASSERT_TRUE(policy.isSolved);
    const VectorXd controls = controlsOf(stages, policy, start);
    EXPECT_LT((controls - best).norm(), 1e-6 * (1 + best.norm())) << round;
    // What P and p say of the cost: from two starts, since a constant is left out.
    const auto valueOf = [&](const VectorXd& x) { return x.dot(policy.P[0] * x) + 2 * policy.p[0].dot(x); };
    const VectorXd other = rng.normalVector(3);
    const double difference = costOf(stages, F, f, other, controlsOf(stages, policy, other)) - cost(controls);
    EXPECT_NEAR(valueOf(other) - valueOf(start), difference, 1e-7 * (1 + std::abs(difference)));
    // Also of policies that damping has spoilt.
    const LqPolicy damped = solveLq(stages, F, f, 5);
    const auto dampedValue = [&](const VectorXd& x) {
      return x.dot(damped.P[0] * x) + 2 * damped.p[0].dot(x);
    };
    const double spoilt = costOf(stages, F, f, other, controlsOf(stages, damped, other)) -
                          costOf(stages, F, f, start, controlsOf(stages, damped, start));
    EXPECT_NEAR(dampedValue(other) - dampedValue(start), spoilt, 1e-7 * (1 + std::abs(spoilt)));
  }
}

// Without a path it is the regulator of the horizon.
TEST(TrackingStages, OfZeroAreTheRegulator) {
  Rng rng(32);
  const MatrixXd A = randomMatrix(3, 3, rng), B = randomMatrix(3, 2, rng), Q = MatrixXd::Identity(3, 3),
                 R = MatrixXd::Identity(2, 2);
  const LqPolicy policy = solveLq(trackingStages(A, B, Q, R, MatrixXd::Zero(3, 11)), Q, VectorXd::Zero(3));
  const RiccatiHorizon horizon = discreteHorizon({.A = A, .B = B, .step = 1}, Q, R, Q, 10);
  ASSERT_TRUE(policy.isSolved);
  for (std::size_t t = 0; t < 10; ++t) {
    EXPECT_LT((policy.K[t] - horizon.K[t]).norm(), 1e-9 * (1 + horizon.K[t].norm()));
    EXPECT_LT((policy.P[t] - horizon.P[t]).norm(), 1e-9 * horizon.P[t].norm());
    EXPECT_EQ(policy.k[t].norm(), 0);
  }
}

// A double integrator sees a step of its path coming, and follows it closely where control is cheap.
TEST(TrackingStages, FollowThePath) {
  MatrixXd A(2, 2), B(2, 1), path = MatrixXd::Zero(2, 101);
  A << 1, 0.1, 0, 1;
  B << 0.005, 0.1;
  for (int t = 0; t <= 100; ++t) path.col(t) = Eigen::Vector2d(std::sin(0.05 * t), 0.5 * std::cos(0.05 * t));
  const MatrixXd Q = MatrixXd::Identity(2, 2), R = 1e-4 * MatrixXd::Identity(1, 1);
  const auto stages = trackingStages(A, B, Q, R, path);
  const LqPolicy policy = solveLq(stages, Q, -Q * path.col(100));
  ASSERT_TRUE(policy.isSolved);
  VectorXd x = VectorXd::Zero(2);
  for (std::size_t t = 0; t < 100; ++t) {
    x = (A * x + B * (policy.k[t] - policy.K[t] * x)).eval();
    if (t > 40) {
      EXPECT_LT((x - path.col(static_cast<Eigen::Index>(t) + 1)).norm(), 0.01) << t;
    }
  }
}

// x^T Q x does not tell Q from its symmetric part.
TEST(SolveLq, TakesSymmetricParts) {
  Rng rng(33);
  const LqStage given = randomStage(rng);
  const auto skewed = [&](const MatrixXd& M) -> MatrixXd {
    const MatrixXd S = randomMatrix(static_cast<int>(M.rows()), static_cast<int>(M.rows()), rng);
    return M + S - S.transpose();
  };
  LqStage other = given;
  other.Q = skewed(given.Q), other.R = skewed(given.R);
  const MatrixXd F = MatrixXd::Identity(3, 3);
  const VectorXd f = rng.normalVector(3);
  const LqPolicy wanted = solveLq({given, given}, F, f, 2), found = solveLq({other, other}, skewed(F), f, 2);
  EXPECT_LT((found.K[0] - wanted.K[0]).norm() + (found.k[0] - wanted.k[0]).norm(), 1e-12);
  EXPECT_LT((found.P[0] - wanted.P[0]).norm() + (found.p[0] - wanted.p[0]).norm(),
            1e-12 * wanted.P[0].norm());
}

TEST(SolveLq, SaysWhatIsWrong) {
  const MatrixXd one = MatrixXd::Identity(1, 1), two = MatrixXd::Identity(2, 2);
  const VectorXd none;
  const LqStage good{.A = one, .B = one, .R = one};
  EXPECT_REX_ERROR(solveLq({}, one, none), "linear quadratic problem: found no stages");
  EXPECT_REX_ERROR(solveLq({good}, MatrixXd::Zero(1, 2), none), "columns of F: found a vector of size 2");
  EXPECT_REX_ERROR(solveLq({good}, one, VectorXd::Zero(3)), "rows of f: found a vector of size 3");
  const auto expect = [&](const auto& change, const char* text) {
    LqStage stage = good;
    change(stage);
    EXPECT_REX_ERROR(solveLq({good, stage}, one, none), text);
  };
  expect([&](LqStage& s) { s.A = two; }, "rows of A of stage 1: found a vector of size 2, wanted size 1");
  expect([&](LqStage& s) { s.A = MatrixXd::Zero(1, 2); }, "columns of A of stage 1");
  expect([&](LqStage& s) { s.B = two; }, "rows of B of stage 1");
  expect([&](LqStage& s) { s.c = VectorXd::Zero(2); }, "rows of c of stage 1");
  expect([&](LqStage& s) { s.Q = two; }, "rows of Q of stage 1");
  expect([&](LqStage& s) { s.R = MatrixXd::Zero(1, 2); }, "columns of R of stage 1");
  expect([&](LqStage& s) { s.S = two; }, "rows of S of stage 1");
  expect([&](LqStage& s) { s.q = VectorXd::Zero(2); }, "rows of q of stage 1");
  expect([&](LqStage& s) { s.r = VectorXd::Zero(2); }, "rows of r of stage 1");
  expect([&](LqStage& s) { s.A *= NAN; }, "matrix A of stage 1: found entries that are not finite");
  expect([&](LqStage& s) { s.B *= NAN; }, "matrix B of stage 1: found entries that are not finite");
  expect([&](LqStage& s) { s.R *= NAN; }, "matrix R of stage 1: found entries that are not finite");
  EXPECT_REX_ERROR(solveLq({good}, NAN * one, none), "matrix F: found entries that are not finite");
  EXPECT_REX_ERROR(solveLq({good}, one, none, -1), "damping of a linear quadratic problem: found -1");
  EXPECT_REX_ERROR(trackingStages(two, two, MatrixXd::Identity(3, 3), two, MatrixXd::Zero(2, 3)),
                   "columns of Q: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(trackingStages(one, one, one, one, MatrixXd::Zero(2, 3)),
                   "rows of the path: found a vector of size 2");
  const LqPolicy failed = solveLq({good, {.A = one, .B = one, .R = -one}}, 0 * one, none);
  EXPECT_FALSE(failed.isSolved);
  EXPECT_EQ(failed.stage, 1);
  EXPECT_EQ(failed.message, "stage 1: the cost of the control has no minimum");
}

}  // namespace rex::lq_tracking_test
