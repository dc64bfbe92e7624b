#include "control/ilqr.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "control/finite_horizon.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "systems/cart_pole.h"

namespace rex::ilqr_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A pendulum, to be swung up by a weak motor in 3 s: x = (angle from upright, its rate).
ControlProblem pendulum() {
  ControlProblem problem;
  problem.next = [](const VectorXd& x, const VectorXd& u) {
    const double h = 0.05, rate = x[1] + h * (9.81 * std::sin(x[0]) + u[0]);
    return VectorXd(Eigen::Vector2d(x[0] + h * rate, rate));
  };
  problem.stage = [](const VectorXd&, const VectorXd& u, int) { return VectorXd(0.05 * u); };
  problem.final = [](const VectorXd& x) { return VectorXd(10 * x); };
  problem.start = Eigen::Vector2d(M_PI, 0);
  return problem;
}

double costOf(const ControlProblem& problem, const MatrixXd& U) {
  VectorXd x = problem.start;
  double cost = 0;
  for (int t = 0; t < U.cols(); ++t) {
    cost += problem.stage(x, U.col(t), t).squaredNorm();
    x = problem.next(x, U.col(t));
  }
  return cost + problem.final(x).squaredNorm();
}

// On a linear quadratic problem, one step leads to the regulator of the horizon.
TEST(Ilqr, IsTheRegulatorInOneStep) {
  Rng rng(33);
  const MatrixXd A = rng.normalVector(9).reshaped(3, 3), B = rng.normalVector(6).reshaped(3, 2);
  ControlProblem problem;
  problem.next = [&](const VectorXd& x, const VectorXd& u) { return VectorXd(A * x + B * u); };
  problem.stage = [](const VectorXd& x, const VectorXd& u, int) {
    VectorXd e(5);
    e << x, u;
    return e;
  };
  problem.final = [](const VectorXd& x) { return VectorXd(2 * x); };
  problem.start = rng.normalVector(3);
  const IlqrResult result = ilqr(problem, MatrixXd::Zero(2, 12));
  EXPECT_EQ(result.status, IlqrStatus::kConverged) << result.message;
  EXPECT_EQ(result.iterations, 1);
  const RiccatiHorizon horizon = discreteHorizon({.A = A, .B = B, .step = 1}, MatrixXd::Identity(3, 3),
                                                 MatrixXd::Identity(2, 2), 4 * MatrixXd::Identity(3, 3), 12);
  EXPECT_NEAR(result.cost, problem.start.dot(horizon.P[0] * problem.start), 1e-8 * result.cost);
  for (std::size_t t = 0; t < 12; ++t)
    EXPECT_LT((result.K[t] - horizon.K[t]).norm(), 1e-7 * (1 + horizon.K[t].norm()));
  EXPECT_NEAR(result.cost, costOf(problem, result.U), 1e-12 * result.cost);
}

// Where it stops, no control changes the cost: the gradient by differences is zero.
TEST(Ilqr, SwingsAPendulumUp) {
  const ControlProblem problem = pendulum();
  const IlqrResult result =
      ilqr(problem, MatrixXd::Constant(1, 60, 0.1), {.maxIterations = 500, .tolerance = 1e-12});
  ASSERT_EQ(result.status, IlqrStatus::kConverged) << result.message;
  EXPECT_THAT(result.message, HasSubstr("converged after"));
  EXPECT_LE(result.residual, 1e-12);
  EXPECT_LT(result.X.col(60).norm(), 0.05) << "it stands";
  EXPECT_LT(result.cost, 0.5 * costOf(problem, MatrixXd::Zero(1, 60)));
  const auto slope = [&](const MatrixXd& U) {
    const auto cost = [&](const VectorXd& u) {
      return VectorXd(VectorXd::Constant(1, costOf(problem, u.transpose())));
    };
    return numericJacobian(cost, U.transpose()).norm();
  };
  EXPECT_LT(slope(result.U), 1e-3 * slope(MatrixXd::Constant(1, 60, 0.1)));
  // Its own gains hold the motion against a push.
  VectorXd x = problem.start + Eigen::Vector2d(0.02, 0);
  for (int t = 0; t < 60; ++t)
    x = problem.next(x, result.U.col(t) - result.K[static_cast<std::size_t>(t)] * (x - result.X.col(t)));
  EXPECT_LT(x.norm(), 0.1);
}

TEST(Ilqr, TakesExactDerivatives) {
  ControlProblem problem = pendulum();
  const IlqrResult numeric = ilqr(problem, MatrixXd::Constant(1, 60, 0.1), {.maxIterations = 500});
  int calls = 0;
  problem.derivative = [&calls](const VectorXd& x, const VectorXd&) {
    ++calls;
    MotionJacobians J{MatrixXd(2, 2), MatrixXd(2, 1)};
    const double h = 0.05;
    J.A << 1 + h * h * 9.81 * std::cos(x[0]), h, h * 9.81 * std::cos(x[0]), 1;
    J.B << h * h, h;
    return J;
  };
  const IlqrResult exact = ilqr(problem, MatrixXd::Constant(1, 60, 0.1), {.maxIterations = 500});
  EXPECT_GT(calls, 60);
  EXPECT_NEAR(exact.cost, numeric.cost, 1e-5 * numeric.cost);
  // Nothing is left that could be asked beside the motion itself.
  problem.stageDerivative = [](const VectorXd&, const VectorXd&, int) {
    return MotionJacobians{MatrixXd::Zero(1, 2), MatrixXd::Constant(1, 1, 0.05)};
  };
  problem.finalDerivative = [](const VectorXd&) { return MatrixXd(10 * MatrixXd::Identity(2, 2)); };
  int stages = 0;
  problem.stage = [&stages](const VectorXd&, const VectorXd& u, int) {
    ++stages;
    return VectorXd(0.05 * u);
  };
  EXPECT_EQ(ilqr(problem, MatrixXd::Constant(1, 60, 0.1), {.maxIterations = 0}).status,
            IlqrStatus::kBudgetSpent);
  EXPECT_EQ(stages, 2 * 60);
  const IlqrResult all = ilqr(problem, MatrixXd::Constant(1, 60, 0.1), {.maxIterations = 500});
  EXPECT_NEAR(all.cost, exact.cost, 1e-5 * exact.cost);
}

TEST(Ilqr, TellsHowFarItCame) {
  const ControlProblem problem = pendulum();
  const MatrixXd U = MatrixXd::Constant(1, 60, 0.1);
  const IlqrResult spent = ilqr(problem, U, {.maxIterations = 2});
  EXPECT_EQ(spent.status, IlqrStatus::kBudgetSpent);
  EXPECT_EQ(spent.iterations, 2);
  EXPECT_LT(spent.cost, costOf(problem, U));
  EXPECT_THAT(spent.message, HasSubstr("iteration limit reached after 2 steps"));
  EXPECT_EQ(ilqr(problem, U, {.maxIterations = 0}).U, U);
  ControlProblem leaping = problem;
  leaping.next = [](const VectorXd& x, const VectorXd&) { return VectorXd(1e200 * x); };
  const IlqrResult diverged = ilqr(leaping, U);
  EXPECT_EQ(diverged.status, IlqrStatus::kDiverged);
  EXPECT_THAT(diverged.message, HasSubstr("the first motion is not finite"));
  // A derivative of the wrong sign promises what no step keeps.
  ControlProblem wrong;
  wrong.next = [](const VectorXd& x, const VectorXd& u) { return VectorXd(x + u); };
  wrong.stage = [](const VectorXd&, const VectorXd& u, int) { return VectorXd(1e-3 * u); };
  wrong.final = [](const VectorXd& x) { return x; };
  wrong.start = VectorXd::Ones(1);
  wrong.derivative = [](const VectorXd&, const VectorXd&) {
    return MotionJacobians{MatrixXd::Identity(1, 1), -MatrixXd::Identity(1, 1)};
  };
  const IlqrResult stuck = ilqr(wrong, MatrixXd::Zero(1, 3));
  EXPECT_EQ(stuck.status, IlqrStatus::kNoProgress) << stuck.message;
  EXPECT_THAT(stuck.message, HasSubstr("no step lowers the cost"));
}

TEST(Ilqr, SaysWhatIsWrong) {
  const MatrixXd U = MatrixXd::Zero(1, 3);
  const auto expect = [&](const auto& change, const char* text) {
    ControlProblem problem = pendulum();
    change(problem);
    EXPECT_REX_ERROR(ilqr(problem, U), text);
  };
  expect([](ControlProblem& p) { p.next = nullptr; }, "control problem: found a function that is missing");
  expect([](ControlProblem& p) { p.start[0] = kNan; }, "start of a control problem: number 0: found nan");
  expect([](ControlProblem& p) { p.next = [](const VectorXd&, const VectorXd& u) { return u; }; },
         "next state: found a vector of size 1, wanted size 2");
  expect(
      [](ControlProblem& p) {
        p.stageDerivative = [](const VectorXd&, const VectorXd&, int) {
          return MotionJacobians{MatrixXd::Zero(1, 2), MatrixXd::Zero(2, 1)};
        };
      },
      "rows of the stage cost's derivative by u: found a vector of size 2, wanted size 1");
  expect([](ControlProblem& p) { p.finalDerivative = [](const VectorXd&) { return MatrixXd(2, 1); }; },
         "columns of the final cost's derivative: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR(ilqr(pendulum(), MatrixXd(1, 0)), "first guess U: found no controls");
  EXPECT_REX_ERROR(ilqr(pendulum(), MatrixXd::Constant(1, 3, kNan)), "first guess U: number 0: found nan");
  EXPECT_REX_ERROR(ilqr(pendulum(), U, {.tolerance = 0}), "tolerance of iLQR: found 0");
  EXPECT_REX_ERROR(ilqr(pendulum(), U, {.damping = -1}), "damping of iLQR: found -1");
  EXPECT_REX_ERROR(ilqr(pendulum(), U, {.maxIterations = -1}),
                   "iterations of iLQR: found -1, wanted 0 or more");
}

// Model-predictive control: planned anew at each step, from the policy of the step before.
TEST(Ilqr, PlannedAnewInEachStepSwingsThePoleUpUnderNoise) {
  const CartPoleDynamics pole;
  ControlProblem problem{
      .next = [&](const VectorXd& x, const VectorXd& u) -> VectorXd {
        return pole.eulerStep(x, 20 * std::tanh(u[0] / 20), 0.05);
      },
      .stage = [](const VectorXd& x, const VectorXd& u, int) -> VectorXd {
        return VectorXd{{0.1 * x[0], 0.1 * x[1], std::sin(x[2] / 2), 0.05 * x[3], 0.02 * u[0]}};
      },
      .final = [](const VectorXd& x) -> VectorXd {
        return VectorXd{{x[0], x[1], 20 * std::sin(x[2] / 2), 3 * x[3]}};
      },
      .start = Eigen::Vector4d(0, 0, M_PI, 0)};
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    problem.start = Eigen::Vector4d(0, 0, M_PI, 0);
    IlqrResult plan = ilqr(problem, MatrixXd::Constant(1, 40, 0.5));
    for (int t = 0; t < 120; ++t) {
      problem.start = problem.next(problem.start, plan.U.col(0)) + 0.01 * rng.normalVector(4);
      plan = ilqr(problem, followedPlan(problem, plan), {.maxIterations = 3});
      ASSERT_TRUE(std::isfinite(plan.cost)) << t;
      if (t >= 80) {
        EXPECT_GT(std::cos(problem.start[2]), 0.98) << t;
      }
    }
  }
  IlqrResult none;
  EXPECT_REX_ERROR((void)followedPlan(problem, none),
                   "the last plan: found no policy, wanted a result of ilqr()");
  const IlqrResult plan = ilqr(problem, MatrixXd::Zero(1, 5), {.maxIterations = 0});
  problem.start = Eigen::Vector2d(0, 0);
  EXPECT_REX_ERROR((void)followedPlan(problem, plan),
                   "start of a control problem: found a vector of size 2, wanted size 4");
}

// Nonlinear model-predictive control of an arm whose motors are too weak to hold it stretched out.
class WeakArm {
 public:
  // Controls are squashed to torques within the strength of the motors.
  Eigen::Vector3d torques(const VectorXd& u) const {
    return strength_.array() * (u.array() / strength_.array()).tanh();
  }
  Eigen::Vector3d off(const VectorXd& x) const {  // of the hand from its target
    return forwardKinematics(model_, x.head(3))[hand_] * Eigen::Vector3d(0, 0, 0.15) -
           Eigen::Vector3d(0, -0.4, 1.4);
  }
  ControlProblem problem() const {
    return {.next = [this](const VectorXd& x, const VectorXd& u) -> VectorXd {
              VectorXd y = x;
              for (int i = 0; i < 2; ++i) {
                y.tail(3) += 0.025 * forwardDynamics(model_, y.head(3), y.tail(3), torques(u));
                y.head(3) += 0.025 * y.tail(3);
              }
              return y;
            },
            .stage = [this](const VectorXd& x, const VectorXd& u, int) -> VectorXd {
              VectorXd e(9);
              e << 2 * off(x), 0.1 * x.tail(3), 0.02 * u;
              return e;
            },
            .final = [this](const VectorXd& x) -> VectorXd {
              VectorXd e(6);
              e << 20 * off(x), 2 * x.tail(3);
              return e;
            },
            .start = (VectorXd(6) << 2.6, 0.3, 0.3, 0, 0, 0).finished()};
  }
  // Plans `horizon` steps anew in each of 40 steps, and returns the controls that were used. `move` moves the
  // arm.
  MatrixXd driven(int horizon, const ControlledMotion& move) const {
    ControlProblem ahead = problem();
    IlqrResult plan = ilqr(ahead, MatrixXd::Constant(3, horizon, 0.1));
    MatrixXd U(3, 40);
    for (int t = 0; t < 40; ++t) {
      U.col(t) = plan.U.col(0);
      ahead.start = move(ahead.start, U.col(t));
      plan = ilqr(ahead, followedPlan(ahead, plan), {.maxIterations = 3});
    }
    return U;
  }
  const Model& model() const { return model_; }

 private:
  const Model model_ = compile(readOrs(sourcePath("data/robots/arm3.ors")).spec);
  const BodyId hand_ = model_.body("eff");
  const Eigen::Array3d strength_{9, 4.5, 1.5};
};

// Against the best motion of all 40 steps, found from where model-predictive control ended.
TEST(Ilqr, PlannedAnewInEachStepCostsAnArmLittleMore) {
  const WeakArm arm;
  const ControlProblem problem = arm.problem();
  const MatrixXd U = arm.driven(20, problem.next);
  const IlqrResult best = ilqr(problem, U);
  ASSERT_EQ(best.status, IlqrStatus::kConverged) << best.message;
  const double cost = costOf(problem, U), shortsighted = costOf(problem, arm.driven(10, problem.next));
  EXPECT_LT(cost, 1.01 * best.cost);
  EXPECT_GT(shortsighted, 1.05 * best.cost);
}

// Moved by Runge-Kutta steps of 5 ms instead of the Euler steps of 25 ms that it plans with, and shaken.
TEST(Ilqr, PlannedAnewInEachStepReachesWithAWeakArmUnderNoise) {
  const WeakArm arm;
  Stepper stepper(arm.model());
  for (const std::uint64_t seed : {1, 2}) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    int t = 0;
    double largest = 0;
    const auto move = [&](const VectorXd& x, const VectorXd& u) -> VectorXd {
      State state{.q = x.head(3), .v = x.tail(3)};
      const Eigen::Vector3d torques = arm.torques(u);
      largest = std::max(largest, std::abs(torques[0]));
      for (int i = 0; i < 10; ++i) stepper.step(state, torques, 0.005);
      VectorXd after(6);
      after << state.q, state.v;
      after += 0.01 * rng.normalVector(6);
      if (++t > 30) {
        EXPECT_LT(arm.off(after).norm(), 0.06) << t;
      }
      return after;
    };
    (void)arm.driven(20, move);
    EXPECT_GT(largest, 8.5);  // of 9 N m; stretched out, it takes 13.2
    EXPECT_LE(largest, 9);
  }
}

}  // namespace rex::ilqr_test
