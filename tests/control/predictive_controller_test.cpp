#include "control/predictive_controller.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/finite_horizon.h"
#include "support/expect_error.h"

namespace rex::predictive_controller_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd one(double number) { return VectorXd::Constant(1, number); }

// A mass of 1 kg pushed by a force, in steps of .1 s.
LinearSystem mass() {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = Eigen::Vector2d(0, 1)};
  system.A(0, 1) = 1;
  return discretized(system, 0.1);
}

PredictiveOptions massOptions() {
  PredictiveOptions options{.Q = Eigen::Vector2d(1, 0.1).asDiagonal(), .R = MatrixXd::Constant(1, 1, 0.1)};
  options.uMin = one(-1), options.uMax = one(1);
  return options;
}

TEST(PredictiveController, IsTheRegulatorWhereNoLimitActs) {
  Rng rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    LinearSystem system{
        .A = rng.normalVector(16).reshaped(4, 4) / 2, .B = rng.normalVector(8).reshaped(4, 2), .step = 0.1};
    PredictiveOptions options{
        .Q = MatrixXd::Identity(4, 4), .R = MatrixXd::Identity(2, 2), .horizon = 1 + trial};
    if (trial % 2) options.uMax = VectorXd::Constant(2, 1e6), options.xMin = VectorXd::Constant(4, -1e6);
    const RiccatiResult regulator = lqr(system, options.Q, options.R);
    const VectorXd x = rng.normalVector(4);
    const PredictedMotion motion = PredictiveController(system, options).plan(x);
    ASSERT_EQ(motion.status, QuadraticStatus::kOptimal);
    EXPECT_LT((motion.U.col(0) + regulator.K * x).norm(), 1e-7 * x.norm());
    EXPECT_NEAR(motion.cost, x.dot(regulator.X * x), 1e-7 * motion.cost);
    EXPECT_TRUE(motion.active.empty());
  }
}

TEST(PredictiveController, OfOneStepIsTheClampedFiniteHorizonRegulator) {
  const LinearSystem system = mass();
  PredictiveOptions options = massOptions();
  options.F = 5 * MatrixXd::Identity(2, 2);
  options.horizon = 1;
  const PredictiveController one(system, options);
  const MatrixXd K = discreteHorizon(system, options.Q, options.R, options.F, 1).K[0];
  Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    const VectorXd x = 3 * rng.normalVector(2);
    EXPECT_NEAR(one.plan(x).U(0, 0), std::clamp(-(K * x)[0], -1.0, 1.0), 1e-12);
  }
}

TEST(PredictiveController, NoOtherControlsWithinTheLimitsCostLess) {
  Rng rng(2);
  PredictiveOptions options = massOptions();
  options.xMax = Eigen::Vector2d(std::numeric_limits<double>::infinity(), 0.8);
  const PredictiveController controller(mass(), options);
  const Eigen::Vector2d x(-3, 0);
  const PredictedMotion best = controller.plan(x);
  ASSERT_EQ(best.status, QuadraticStatus::kOptimal) << best.message;
  EXPECT_GT(best.active.size(), 5u);
  EXPECT_LT(best.residual, 1e-9);
  EXPECT_NEAR(best.X.row(1).maxCoeff(), 0.8, 1e-9);
  const LinearSystem system = mass();
  const MatrixXd F = lqr(system, options.Q, options.R).X;
  int tried = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double size = std::pow(10, rng.uniform(-5, -1));
    const VectorXd U = (best.U.reshaped() + size * rng.normalVector(20)).cwiseMax(-1).cwiseMin(1);
    VectorXd state = x;
    double cost = 0;
    bool isAllowed = true;
    for (int t = 0; t < 20; ++t) {
      cost += state.dot(options.Q * state) + 0.1 * U[t] * U[t];
      state = system.A * state + system.B * U[t];
      isAllowed &= state[1] <= 0.8;
    }
    if (!isAllowed) continue;
    ++tried;
    EXPECT_GT(cost + state.dot(F * state), best.cost);
  }
  EXPECT_GT(tried, 50);
}

TEST(PredictiveController, BringsTheMassHomeWithAndWithoutTheLastPlan) {
  const PredictiveController controller(mass(), massOptions());
  const LinearSystem system = mass();
  VectorXd x = Eigen::Vector2d(-3, 1);
  PredictedMotion last = controller.plan(x);
  for (int t = 0; t < 100; ++t) {
    const PredictedMotion fresh = controller.plan(x), next = controller.plan(x, &last);
    ASSERT_LT((fresh.U - next.U).norm(), 1e-8);
    EXPECT_LE(next.U.cwiseAbs().maxCoeff(), 1 + 1e-12);
    // What was planned before is still possible, so it cannot become more expensive.
    EXPECT_LE(next.cost, last.cost + 1e-9);
    x = system.A * x + system.B * next.U.col(0);
    last = next;
  }
  EXPECT_LT(x.norm(), 1e-3);
}

TEST(PredictiveController, GoesToATargetThatIsAnEquilibrium) {
  const LinearSystem system = completed(mass());
  const RestPoint target = restAt(system, Eigen::Vector2d(2, 0));
  ASSERT_TRUE(target.isExact);
  const PredictiveController controller(system, massOptions());
  VectorXd x = Eigen::Vector2d(-1, 0);
  for (int t = 0; t < 120; ++t) x = system.A * x + system.B * controller.plan(x, target).U.col(0);
  EXPECT_LT((x - target.x).norm(), 1e-3);
}

TEST(PredictiveController, SaysWhichLimitCannotBeKept) {
  PredictiveOptions options = massOptions();
  options.xMax = Eigen::Vector2d(0.5, 10);
  const Eigen::Vector2d tooFast(0, 1.2);  // stops after .72 m
  const PredictedMotion none = PredictiveController(mass(), options).plan(tooFast);
  EXPECT_EQ(none.status, QuadraticStatus::kInfeasible);
  EXPECT_EQ(none.message.rfind("no controls within the limits bring x[0] below 0.5 at step ", 0), 0u)
      << none.message;
  EXPECT_EQ(none.U.size(), 0);
  options.slackWeight = 100;
  const PredictedMotion soft = PredictiveController(mass(), options).plan(tooFast);
  ASSERT_EQ(soft.status, QuadraticStatus::kOptimal);
  EXPECT_NEAR(soft.violation, soft.X.row(0).maxCoeff() - 0.5, 1e-9);
  EXPECT_NEAR(soft.violation, 0.22, 0.05);
  // Where limits can be kept they are, and at the same cost.
  const Eigen::Vector2d slow(0, 0.9);
  options.slackWeight = 1e4;
  const PredictedMotion kept = PredictiveController(mass(), options).plan(slow);
  options.slackWeight = 0;
  EXPECT_LT(kept.violation, 1e-9);
  EXPECT_NEAR(kept.cost, PredictiveController(mass(), options).plan(slow).cost, 1e-7);
}

TEST(PredictiveController, RefusesWhatDoesNotFit) {
  const LinearSystem system = mass();
  const auto made = [&](auto change) {
    PredictiveOptions options = massOptions();
    change(options);
    return PredictiveController(system, options);
  };
  LinearSystem continuous = system;
  continuous.step.reset();
  EXPECT_REX_ERROR(
      PredictiveController(continuous, massOptions()),
      "predictive control: found a system in continuous time, wanted one in discrete time: discretized()");
  EXPECT_REX_ERROR(made([](auto& o) { o.horizon = 0; }),
                   "horizon of predictive control: found 0, wanted at least 1");
  EXPECT_REX_ERROR(made([](auto& o) { o.slackWeight = -1; }), "slack weight of predictive control: found -1");
  EXPECT_REX_ERROR(made([](auto& o) { o.R *= -1; }), "matrix R: found the eigenvalue -0.1");
  EXPECT_REX_ERROR(made([](auto& o) { o.Q *= -1; }), "matrix Q: found the eigenvalue -1");
  EXPECT_REX_ERROR(made([](auto& o) { o.F = MatrixXd::Zero(1, 1); }), "rows of F: found a vector of size 1");
  EXPECT_REX_ERROR(made([](auto& o) { o.Q.setZero(); }),
                   "predictive control: no cost after the horizon: found ");
  EXPECT_REX_ERROR(
      made([](auto& o) { o.uMax = one(-2); }),
      "predictive control: limits of u[0]: found -1 and -2, wanted a lower one that is not above the "
      "upper one");
  EXPECT_REX_ERROR(made([](auto& o) { o.xMin = one(0); }),
                   "predictive control: xMin: found a vector of size 1, wanted size 2");
  const PredictiveController controller(system, massOptions());
  const RestPoint home{.x = Eigen::Vector2d::Zero(), .u = one(0)};
  EXPECT_REX_ERROR((void)controller.plan(one(0)),
                   "predictive control: state: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR((void)controller.plan(home.x, {.x = one(0), .u = one(0)}),
                   "predictive control: target state: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR((void)controller.plan(home.x, {.x = home.x, .u = home.x}),
                   "predictive control: target control: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR((void)controller.plan(home.x * std::nan("")),
                   "predictive control: state: number 0: found nan");
}

}  // namespace rex::predictive_controller_test
