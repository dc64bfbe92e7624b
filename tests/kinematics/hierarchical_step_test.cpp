#include "kinematics/hierarchical_step.h"

#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "kinematics/inverse_kinematics.h"
#include "support/expect_error.h"

namespace rex::hierarchical_step_test {

TaskLevel randomLevel(Rng& rng, int d, int n) {
  return {.J = rng.normalVector(d * n).reshaped(d, n), .dy = rng.normalVector(d)};
}

Eigen::MatrixXd randomMetric(Rng& rng, int n) {
  const Eigen::MatrixXd A = rng.normalVector(n * n).reshaped(n, n);
  return A * A.transpose() + Eigen::MatrixXd::Identity(n, n);
}

TEST(HierarchicalStep, FulfilsAllLevelsWhereItCan) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const std::vector<TaskLevel> levels{randomLevel(rng, 3, 12), randomLevel(rng, 4, 12),
                                        randomLevel(rng, 2, 12)};
    const Eigen::VectorXd dq = hierarchicalStep(levels, {.W = randomMetric(rng, 12)});
    for (const TaskLevel& level : levels) EXPECT_LT((level.J * dq - level.dy).norm(), 1e-9);
  }
}

TEST(HierarchicalStep, NeverLetsALowerLevelDisturbAHigherOne) {
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    // Together more than the 7 joints can do; the second is almost the first, where damping acts.
    const TaskLevel first = randomLevel(rng, 3, 7), last = randomLevel(rng, 5, 7);
    TaskLevel second = first;
    second.J += 1e-5 * rng.normalVector(21).reshaped(3, 7);
    second.dy = rng.normalVector(3);
    const Eigen::MatrixXd W = randomMetric(rng, 7);
    const Eigen::VectorXd alone = hierarchicalStep({first}, {.W = W});
    const Eigen::VectorXd all = hierarchicalStep({first, second, last}, {.W = W, .a = rng.normalVector(7)});
    EXPECT_GT((all - alone).norm(), 1e-2);
    EXPECT_LT((first.J * (all - alone)).norm(), 1e-10 * (1 + all.norm()));
  }
}

// Slide 2:50 in the limit, which the step of the stacked tasks of slide 2:48 approaches.
TEST(HierarchicalStep, IsTheLimitOfLargePrecisions) {
  Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    const TaskLevel first = randomLevel(rng, 3, 7), second = randomLevel(rng, 6, 7);
    const Eigen::MatrixXd W = randomMetric(rng, 7);
    const Eigen::VectorXd strict = hierarchicalStep({first, second}, {.W = W, .damping = 0});
    double before = 1e9;
    for (const double rho : {1e2, 1e3, 1e4, 1e5}) {
      Eigen::MatrixXd J(9, 7);
      J << first.J, second.J;
      Eigen::VectorXd dy(9), C(9);
      dy << first.dy, second.dy;
      C << Eigen::Vector3d::Constant(rho * rho), Eigen::VectorXd::Constant(6, rho);
      const Eigen::VectorXd stacked =
          inverseKinematicsStep(J, dy, {.W = W, .C = C.asDiagonal(), .form = StepForm::kJointSpace});
      const double distance = (stacked - strict).norm();
      EXPECT_LT(distance, before);
      before = distance;
    }
    EXPECT_LT(before, 1e-2 * (1 + strict.norm()));
  }
}

// The minimiser of |J2 dq - dy2| among all dq with J1 dq = dy1, by Lagrange's multipliers.
TEST(HierarchicalStep, SolvesTheConstrainedLeastSquares) {
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const TaskLevel first = randomLevel(rng, 2, 5), second = randomLevel(rng, 7, 5);
    const Eigen::VectorXd dq = hierarchicalStep({first, second}, {.damping = 0});
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(7, 7);
    K.topLeftCorner(5, 5) = second.J.transpose() * second.J;
    K.topRightCorner(5, 2) = first.J.transpose();
    K.bottomLeftCorner(2, 5) = first.J;
    Eigen::VectorXd right(7);
    right << second.J.transpose() * second.dy, first.dy;
    EXPECT_LT((dq - K.fullPivLu().solve(right).head(5)).norm(), 1e-9);
  }
}

TEST(HierarchicalStep, GoesTowardsTheWishWhereLevelsLeaveAChoice) {
  Rng rng(5);
  const TaskLevel level = randomLevel(rng, 3, 7);
  const Eigen::MatrixXd W = randomMetric(rng, 7);
  const Eigen::VectorXd a = rng.normalVector(7);
  const Eigen::VectorXd dq = hierarchicalStep({level}, {.W = W, .a = a});
  EXPECT_LT((level.J * dq - level.dy).norm(), 1e-10);
  // Nearest in W: what remains is orthogonal, in W, to every motion that the level does not feel.
  const Eigen::MatrixXd kernel = level.J.fullPivLu().kernel();
  ASSERT_EQ(kernel.cols(), 4);
  EXPECT_LT((kernel.transpose() * W * (dq - a)).norm(), 1e-9);
  const Eigen::VectorXd soft =
      inverseKinematicsStep(level.J, level.dy, {.W = W, .C = 1e8 * Eigen::MatrixXd::Identity(3, 3), .a = a});
  EXPECT_LT((soft - dq).norm(), 1e-5);
}

TEST(HierarchicalStep, StaysBoundedWhereSingular) {
  TaskLevel level{.J = Eigen::MatrixXd::Zero(2, 3), .dy = Eigen::Vector2d(1, 1)};
  EXPECT_EQ(hierarchicalStep({level}), Eigen::VectorXd::Zero(3));
  for (const double s : {1e-12, 1e-9, 1e-5, 1e-4, 1e-3}) {
    level.J << 1, 0, 0, 0, s, 0;
    const Eigen::VectorXd dq = hierarchicalStep({level}, {.damping = 1e-3});
    EXPECT_NEAR(dq[0], 1, 1e-12);
    EXPECT_LE(std::abs(dq[1]), 1000 * (1 + 1e-12)) << s;
    EXPECT_NEAR(dq[1], s < 1e-10 ? 0 : s / 1e-6, 1e-9) << s;
  }
  level.J << 1, 0, 0, 0, 0.01, 0;
  EXPECT_NEAR(hierarchicalStep({level})[1], 100, 1e-9);
}

// What a level adds, measured in W, against the bound of the header.
TEST(HierarchicalStep, BoundsTheShareOfEachLevel) {
  const std::vector<TaskLevel> conflict{{.J = Eigen::RowVector2d(1, 0), .dy = Eigen::VectorXd::Ones(1)},
                                        {.J = Eigen::RowVector2d(100, 1e-3), .dy = Eigen::VectorXd::Zero(1)}};
  EXPECT_LT((hierarchicalStep(conflict) - Eigen::Vector2d(1, -1e5)).norm(), 1e-6);
  Rng rng(7);
  double greatest = 0;
  for (int i = 0; i < 50; ++i) {
    const TaskLevel first = randomLevel(rng, 3, 7);
    TaskLevel second = first;
    second.J += std::pow(10, rng.uniform(-6, 0)) * rng.normalVector(21).reshaped(3, 7);
    const Eigen::MatrixXd W = randomMetric(rng, 7);
    const double damping = std::pow(10, rng.uniform(-4, -1));
    const Eigen::VectorXd before = hierarchicalStep({first}, {.W = W, .damping = damping});
    const Eigen::VectorXd share = hierarchicalStep({first, second}, {.W = W, .damping = damping}) - before;
    const double bound = (second.dy - second.J * before).norm() / damping;
    EXPECT_LE(std::sqrt(share.dot(W * share)), bound * (1 + 1e-9) + 1e-12);
    greatest = std::max(greatest, std::sqrt(share.dot(W * share)) / bound);
  }
  EXPECT_GT(greatest, 0.1);
}

TEST(HierarchicalStep, RefusesBadArguments) {
  Rng rng(6);
  const TaskLevel level = randomLevel(rng, 3, 7);
  EXPECT_REX_ERROR(hierarchicalStep({}), "hierarchy of tasks: found no level, wanted at least one");
  EXPECT_REX_ERROR(hierarchicalStep({level}, {.damping = -1}),
                   "damping: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(hierarchicalStep({level}, {.damping = HUGE_VAL}), "damping: found inf");
  EXPECT_REX_ERROR(hierarchicalStep({level, randomLevel(rng, 2, 6)}),
                   "Jacobian of a level, per row: found a vector of size 6, wanted size 7");
  EXPECT_REX_ERROR(hierarchicalStep({{.J = level.J, .dy = Eigen::Vector2d(1, 1)}}),
                   "task change dy of a level: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(hierarchicalStep({level}, {.W = -Eigen::MatrixXd::Identity(7, 7)}),
                   "metric W: wanted a symmetric, positive definite matrix");
  EXPECT_REX_ERROR(hierarchicalStep({level}, {.a = Eigen::Vector2d(1, 1)}),
                   "desired posture change a: found a vector of size 2, wanted size 7");
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    const auto broken = [&](int size) { return Eigen::VectorXd::Constant(size, bad); };
    EXPECT_REX_ERROR(hierarchicalStep({level, {.J = broken(7).transpose(), .dy = Eigen::VectorXd::Ones(1)}}),
                     fmt::format("Jacobian of a level: number 0: found {}, wanted a finite number", bad));
    EXPECT_REX_ERROR(hierarchicalStep({{.J = level.J, .dy = broken(3)}}),
                     fmt::format("task change dy of a level: number 0: found {}", bad));
    EXPECT_REX_ERROR(hierarchicalStep({level}, {.a = broken(7)}),
                     fmt::format("desired posture change a: number 0: found {}", bad));
  }
}

}  // namespace rex::hierarchical_step_test
