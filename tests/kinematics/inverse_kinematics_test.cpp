#include "kinematics/inverse_kinematics.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::inverse_kinematics_test {

TEST(InverseKinematicsStep, EqualsTheOtherWoodburyForm) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const int d = 1 + rng.index(8), n = 1 + rng.index(30);
    const Eigen::MatrixXd J = rng.normalVector(d * n).reshaped(d, n);
    const Eigen::VectorXd dy = rng.normalVector(d);
    const Eigen::MatrixXd JtJ = J.transpose() * J + 0.01 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd wanted = JtJ.ldlt().solve(J.transpose() * dy);
    EXPECT_LT((inverseKinematicsStep(J, dy, 0.1) - wanted).norm(), 1e-9 * (1 + wanted.norm()));
  }
}

TEST(InverseKinematicsStep, MinimisesItsCost) {
  Rng rng(2);
  const Eigen::MatrixXd J = rng.normalVector(3 * 7).reshaped(3, 7);
  const Eigen::VectorXd dy = rng.normalVector(3);
  const auto cost = [&](const Eigen::VectorXd& dq) {
    return (J * dq - dy).squaredNorm() + 0.04 * dq.squaredNorm();
  };
  const Eigen::VectorXd best = inverseKinematicsStep(J, dy, 0.2);
  for (int i = 0; i < 100; ++i) EXPECT_GT(cost(best + 1e-3 * rng.normalVector(7)), cost(best));
}

TEST(InverseKinematicsStep, StaysBoundedAtASingularity) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_EQ(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), 0.01), Eigen::VectorXd::Zero(5));
}

TEST(InverseKinematicsStep, RefusesBadArguments) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector2d(1, 1), 0.1),
                   "task change dy: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), 0),
                   "regularisation sigma: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), HUGE_VAL),
                   "regularisation sigma: found inf");
}

// A problem with full metrics; `diagonal` ones as the course has them.
struct Problem {
  Eigen::MatrixXd J;
  Eigen::VectorXd dy;
  StepOptions options;
};

Eigen::MatrixXd randomMetric(Rng& rng, int n, bool diagonal) {
  if (diagonal) return Eigen::VectorXd(rng.uniformVector(n, 0.1, 3)).asDiagonal();
  const Eigen::MatrixXd A = rng.normalVector(n * n).reshaped(n, n);
  return A * A.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

Problem randomProblem(Rng& rng, int d, int n, bool diagonal) {
  return {.J = rng.normalVector(d * n).reshaped(d, n),
          .dy = rng.normalVector(d),
          .options = {.W = randomMetric(rng, n, diagonal),
                      .C = randomMetric(rng, d, diagonal),
                      .a = rng.normalVector(n)}};
}

Eigen::VectorXd solved(Problem problem, StepForm form) {
  problem.options.form = form;
  return inverseKinematicsStep(problem.J, problem.dy, problem.options);
}

TEST(StepWithMetrics, IsTheSameInBothWoodburyForms) {
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const int d = 1 + rng.index(12), n = 1 + rng.index(12);
    const bool diagonal = i % 2 == 0;
    const Problem problem = randomProblem(rng, d, n, diagonal);
    const Eigen::VectorXd inJoints = solved(problem, StepForm::kJointSpace);
    const Eigen::VectorXd inTask = solved(problem, StepForm::kTaskSpace);
    EXPECT_LT((inJoints - inTask).norm(), 1e-9 * (1 + inTask.norm()));
    EXPECT_EQ(solved(problem, StepForm::kCheaper), diagonal && d < n ? inTask : inJoints);
  }
}

TEST(StepWithMetrics, HasNoSlopeAtItsMinimum) {
  Rng rng(4);
  for (int i = 0; i < 100; ++i) {
    const Problem p = randomProblem(rng, 1 + rng.index(8), 1 + rng.index(8), i % 2 == 0);
    const Eigen::VectorXd dq = inverseKinematicsStep(p.J, p.dy, p.options);
    const Eigen::VectorXd slope =
        p.options.W * (dq - p.options.a) + p.J.transpose() * (p.options.C * (p.J * dq - p.dy));
    EXPECT_LT(slope.norm(), 1e-9 * (1 + dq.norm()));
  }
}

TEST(StepWithMetrics, EqualsTheOneWithSigma) {
  Rng rng(5);
  const Eigen::MatrixXd J = rng.normalVector(21).reshaped(3, 7);
  const Eigen::Vector3d dy = rng.normalVector(3);
  const StepOptions options{.C = Eigen::MatrixXd::Identity(3, 3) / 0.04};
  EXPECT_LT((inverseKinematicsStep(J, dy, options) - inverseKinematicsStep(J, dy, 0.2)).norm(), 1e-14);
}

// Exercise 4.1: for rho -> infinity the task is fulfilled exactly, and nullspace motion does not touch it.
TEST(StepWithMetrics, FulfilsTheTaskInTheLimit) {
  Rng rng(6);
  Problem p = randomProblem(rng, 3, 7, false);
  const Eigen::MatrixXd C0 = p.options.C;
  double miss = 1e9, disturbance = 1e9;
  for (const double rho : {1e1, 1e3, 1e5, 1e7}) {
    p.options.C = rho * C0;
    const Eigen::VectorXd dq = inverseKinematicsStep(p.J, p.dy, p.options);
    const Eigen::VectorXd still = inverseKinematicsStep(p.J, Eigen::Vector3d::Zero(), p.options);
    EXPECT_LT((p.J * dq - p.dy).norm(), 0.02 * miss);
    EXPECT_LT((p.J * still).norm(), 0.02 * disturbance);
    miss = (p.J * dq - p.dy).norm();
    disturbance = (p.J * still).norm();
    EXPECT_GT(still.norm(), 0.1);
  }
}

TEST(StepWithMetrics, RefusesBadArguments) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Ones(2, 3);
  const Eigen::Vector2d dy(1, 1);
  EXPECT_REX_ERROR(inverseKinematicsStep(J, Eigen::Vector3d(1, 1, 1), StepOptions{}),
                   "task change dy: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, dy, {.W = Eigen::MatrixXd::Identity(2, 2)}),
                   "metric W: found 2 x 2, wanted 3 x 3, or empty for the identity");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, dy, {.C = Eigen::MatrixXd::Identity(3, 2)}),
                   "metric C: found 3 x 2, wanted 2 x 2, or empty for the identity");
  EXPECT_REX_ERROR(inverseKinematicsStep(J, dy, {.a = dy}),
                   "desired posture change a: found a vector of size 2, wanted size 3");
  Eigen::Matrix2d skewed, indefinite, unknown;
  skewed << 1, 0.5, 0, 1;
  indefinite << 1, 2, 2, 1;
  unknown << 1, 0, 0, std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Matrix2d& C :
       {skewed, indefinite, unknown, Eigen::Matrix2d(-Eigen::Matrix2d::Identity())})
    EXPECT_REX_ERROR(inverseKinematicsStep(J, dy, {.C = C}),
                     "metric C: wanted a symmetric, positive definite matrix");
}

}  // namespace rex::inverse_kinematics_test
