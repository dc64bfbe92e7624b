#include "control/predictive_controller.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/finite_horizon.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/ors_reader.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/quadratic_peer.h"

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

// The same problem without eliminating the states: each step has the variables (u_t, x_{t+1}, s_t) and, as
// rows, the equation of the system and the limits. The value lacks `constant`.
struct ProgramOfStates {
  MatrixXd H, A;
  VectorXd g, lower, upper;
  double constant = 0;
};

ProgramOfStates programOfStates(const LinearSystem& system, const PredictiveOptions& options,
                                const RestPoint& target, const VectorXd& x) {
  const Eigen::Index n = x.size(), m = target.u.size(), N = options.horizon, width = m + n + 1,
                     height = 3 * n + m + 1;
  const double infinite = std::numeric_limits<double>::infinity();
  const bool isSoft = options.slackWeight > 0;
  const MatrixXd I = MatrixXd::Identity(n, n);
  ProgramOfStates p{.H = MatrixXd::Zero(N * width, N * width),
                    .A = MatrixXd::Zero(N * height, N * width),
                    .g = VectorXd::Zero(N * width),
                    .lower = VectorXd(N * height),
                    .upper = VectorXd(N * height)};
  p.constant = (x - target.x).dot(options.Q * (x - target.x));
  for (Eigen::Index t = 0; t < N; ++t) {
    const Eigen::Index u = t * width, next = u + m, s = next + n, row = t * height;
    const MatrixXd& Q = t + 1 < N ? options.Q : options.F;
    p.H.block(u, u, m, m) = 2 * options.R;
    p.H.block(next, next, n, n) = 2 * Q;
    p.H(s, s) = isSoft ? 2 * options.slackWeight : 1;
    p.g.segment(u, width) << -2 * options.R * target.u, -2 * Q * target.x, options.slackWeight;
    p.constant += target.u.dot(options.R * target.u) + target.x.dot(Q * target.x);
    p.A.block(row, u, n, m) = -system.B;
    p.A.block(row, next, n, n) = I;
    if (t > 0) p.A.block(row, next - width, n, n) = -system.A;
    p.A.block(row + n, u, m, m).setIdentity();
    p.A.block(row + n + m, next, n, n) = I;
    p.A.block(row + n + m, s, n, 1).setConstant(-1);
    p.A.block(row + 2 * n + m, next, n, n) = I;
    p.A.block(row + 2 * n + m, s, n, 1).setOnes();
    p.A(row + height - 1, s) = 1;
    const VectorXd before = t > 0 ? VectorXd::Zero(n) : VectorXd(system.A * x);
    p.lower.segment(row, height) << before, options.uMin, VectorXd::Constant(n, -infinite), options.xMin, 0;
    p.upper.segment(row, height) << before, options.uMax, options.xMax, VectorXd::Constant(n, infinite),
        isSoft ? infinite : 0;
  }
  return p;
}

TEST(PredictiveController, AgreesWithAPackagedSolver) {
  REX_NEEDS_CVXOPT();
  Rng rng(4);
  const auto positive = [&](int size) -> MatrixXd {
    const MatrixXd root = rng.normalVector(size * size).reshaped(size, size);
    return root * root.transpose() + 0.1 * MatrixXd::Identity(size, size);
  };
  QuadraticPeer peer;
  std::vector<PredictedMotion> motions;
  std::vector<double> constants;
  double outside = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 2 + trial % 3, m = 1 + trial % 2;
    const LinearSystem system{.A = rng.normalVector(n * n).reshaped(n, n) / std::sqrt(n),
                              .B = rng.normalVector(n * m).reshaped(n, m),
                              .C = MatrixXd::Identity(m, n),
                              .step = 0.1};
    PredictiveOptions options{.Q = positive(n), .R = positive(m), .F = positive(n), .horizon = 5 + trial};
    options.uMin = VectorXd::Constant(m, -0.5), options.uMax = VectorXd::Constant(m, 0.4);
    const VectorXd start = 2 * rng.normalVector(n);
    const RestPoint target = restPoint(completed(system), rng.normalVector(m));
    ASSERT_TRUE(target.isExact);
    // Hard limits are those of a motion that is possible, so that there is one within them.
    VectorXd x = start;
    options.xMin.setConstant(n, HUGE_VAL), options.xMax.setConstant(n, -HUGE_VAL);
    for (int t = 0; t < options.horizon; ++t) {
      x = system.A * x + system.B * VectorXd::NullaryExpr(m, [&] { return rng.uniform(-0.5, 0.4); });
      options.xMin = options.xMin.cwiseMin(x), options.xMax = options.xMax.cwiseMax(x);
    }
    if (trial >= 5) options.slackWeight = 10, options.xMin *= 0.5, options.xMax *= 0.5;
    motions.push_back(PredictiveController(system, options).plan(start, target));
    ASSERT_EQ(motions.back().status, QuadraticStatus::kOptimal);
    EXPECT_FALSE(motions.back().active.empty());
    outside = std::max(outside, motions.back().violation);
    const ProgramOfStates p = programOfStates(system, options, target, start);
    peer.add(p.H, p.g, p.A, p.lower, p.upper);
    constants.push_back(p.constant);
  }
  EXPECT_GT(outside, 0.1);
  const std::vector<QuadraticPeer::Minimum> theirs = peer.minima();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const MatrixXd &X = motions[i].X, &U = motions[i].U;
    const double cost = theirs[i].value + constants[i];
    EXPECT_NEAR(motions[i].cost, cost, 1e-9 * cost);
    for (Eigen::Index t = 0; t < U.cols(); ++t) {
      const VectorXd step = theirs[i].x.segment(t * (U.rows() + X.rows() + 1), U.rows() + X.rows());
      EXPECT_LT((U.col(t) - step.head(U.rows())).norm(), 1e-7);
      EXPECT_LT((X.col(t + 1) - step.tail(X.rows())).norm(), 1e-7);
    }
  }
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
  const RestPoint target = restPoint(system, Eigen::Vector2d(2, 0));
  ASSERT_TRUE(target.isExact);
  const PredictiveController controller(system, massOptions());
  VectorXd x = Eigen::Vector2d(-1, 0);
  for (int t = 0; t < 120; ++t) x = system.A * x + system.B * controller.plan(x, target).U.col(0);
  EXPECT_LT((x - target.x).norm(), 1e-3);
}

// The arm's motors hardly hold it at the goal. In each step the controller gets the linear model around its
// state, in differences from the goal and from the torques under which that model rests there; the arm itself
// moves by its nonlinear dynamics.
TEST(PredictiveController, MovesAnArmWithinTorquesAndSpeeds) {
  const Model arm = compile(readOrs(sourcePath("data/robots/arm3.ors")).spec);
  const ControlledMotion rate = [&](const VectorXd& x, const VectorXd& u) {
    VectorXd slope(6);
    slope << x.tail(3), forwardDynamics(arm, x.head(3), x.tail(3), u);
    return slope;
  };
  const Eigen::Vector3d goal(0.3, 0.6, 0.5), strength(11, 4, 1);
  EXPECT_GT(gravityForces(arm, goal).norm(), 10);
  VectorXd rest = VectorXd::Zero(6), weights = VectorXd::Ones(6);
  rest.head(3) = goal, weights.head(3).setConstant(10);
  PredictiveOptions options{.Q = weights.asDiagonal(), .R = 0.01 * MatrixXd::Identity(3, 3)};
  options.xMax.setConstant(6, HUGE_VAL), options.xMax.tail(3).setConstant(0.8);
  options.xMin = -options.xMax, options.slackWeight = 1e4;
  PredictiveOptions wide{.Q = options.Q, .R = options.R, .uMax = VectorXd::Constant(3, 1e6)};
  Stepper stepper(arm);
  for (const bool isPlanned : {true, false}) {
    SCOPED_TRACE(isPlanned);
    State state{.q = Eigen::Vector3d(0.9, -0.2, -0.3), .v = VectorXd::Zero(3)};
    VectorXd x(6), u = gravityForces(arm, state.q);
    PredictedMotion last;
    double fastest = 0;
    int saturated = 0;
    for (int t = 0; t < 80; ++t) {
      x << state.q, state.v;
      const Linearization near = linearized(rate, x, u);
      const LinearSystem system = discretized({.A = near.A, .B = near.B}, 0.05);
      const VectorXd left = near.value + near.A * (rest - x),
                     hold = u - massMatrix(arm, state.q) * left.tail(3),
                     regulated = -lqr(system, options.Q, options.R).K * (x - rest);
      if (isPlanned) {
        EXPECT_LT((PredictiveController(system, wide).plan(x - rest).U.col(0) - regulated).norm(), 1e-7);
        options.uMin = -strength - hold, options.uMax = strength - hold;
        last = PredictiveController(system, options).plan(x - rest, t > 0 ? &last : nullptr);
        ASSERT_EQ(last.status, QuadraticStatus::kOptimal);
        u = hold + last.U.col(0);
        EXPECT_LT((u.cwiseAbs() - strength).maxCoeff(), 1e-9);
      } else {
        u = (hold + regulated).cwiseMax(-strength).cwiseMin(strength);
      }
      saturated += (u.cwiseAbs() - strength).maxCoeff() > -1e-9;
      for (int i = 0; i < 10; ++i) {
        stepper.step(state, u, 0.005);
        fastest = std::max(fastest, state.v.cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT((state.q - goal).norm(), 1e-3);
    EXPECT_GT(saturated, 10);
    // The speeds are off by what the torques' model is; the regulator that is cut off knows no speeds.
    if (isPlanned)
      EXPECT_LT(fastest, 0.81);
    else
      EXPECT_GT(fastest, 2.5);
  }
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
