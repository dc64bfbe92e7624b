#include "control/value_grid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "control/finite_horizon.h"
#include "control/riccati.h"
#include "support/expect_error.h"

namespace rex::value_grid_test {

using Eigen::Vector2d;
using testing::HasSubstr;

// A mass with friction, pulled to 0.
PlanarControlProblem mass() {
  return {.rate = [](const Vector2d& x, double u) { return Vector2d(x[1], -0.5 * x[1] + u); },
          .cost = [](const Vector2d& x, double u) { return x.squaredNorm() + u * u; },
          .uMin = -4,
          .uMax = 4,
          .discount = 0.2};
}

ValueGridOptions massOptions(int nodes) {
  return {.lower = {-2, -2},
          .upper = {2, 2},
          .nodes = {nodes, nodes},
          .controls = 161,
          .step = 0.1,
          .tolerance = 1e-9};
}

// Both the step and its cost are those of a linear quadratic problem in discrete time, which Bellman's
// equation solves.
TEST(ValueGrid, IsOfSecondOrderWhereTheValueIsKnown) {
  const PlanarControlProblem problem = mass();
  const double h = 0.1, fade = std::exp(-problem.discount * h);
  Eigen::Matrix2d A;
  A << 0, 1, 0, -0.5;
  const Eigen::Matrix2d Ah = h * A;
  const Eigen::Matrix2d powers = Eigen::Matrix2d::Identity() + Ah / 2 + Ah * Ah / 6 + Ah * Ah * Ah / 24;
  LqStage stage{.A = Eigen::Matrix2d::Identity() + Ah * powers, .B = h * powers * Vector2d(0, 1)};
  const Eigen::Matrix2d toMiddle = Eigen::Matrix2d::Identity() + Ah / 2 + Ah * Ah / 8;
  const Vector2d B1 = (h / 2 * Eigen::Matrix2d::Identity() + h * Ah / 8) * Vector2d(0, 1);
  const double half = std::exp(-problem.discount * h / 2);
  stage.Q = h / 6 *
            (Eigen::Matrix2d::Identity() + 4 * half * toMiddle.transpose() * toMiddle +
             fade * stage.A.transpose() * stage.A);
  stage.R = h / 6 * (1 + 4 * half + fade + 4 * half * B1.squaredNorm() + fade * stage.B.squaredNorm()) *
            Eigen::MatrixXd::Ones(1, 1);
  stage.S = h / 6 * (4 * half * B1.transpose() * toMiddle + fade * stage.B.transpose() * stage.A);
  // Discounted: as if the system shrank by sqrt(fade) in each step.
  stage.A *= std::sqrt(fade), stage.B *= std::sqrt(fade);
  const LqPolicy policy =
      solveLq(std::vector<LqStage>(400, stage), Eigen::Matrix2d::Zero(), Vector2d::Zero());
  ASSERT_TRUE(policy.isSolved);
  double errors[2];
  for (const int fine : {0, 1}) {
    const ValueGrid grid(problem, massOptions(fine ? 81 : 41));
    ASSERT_TRUE(grid.isConverged());
    errors[fine] = 0;
    for (const double p : {-0.8, -0.3, 0.2, 0.7})
      for (const double v : {-0.6, 0.1, 0.5}) {
        const Vector2d x(p, v);
        errors[fine] = std::max(errors[fine], std::abs(grid.value(x) - x.dot(policy.P[0] * x)));
        EXPECT_NEAR(grid.control(x), -(policy.K[0] * x)[0], fine ? 0.06 : 0.2);
      }
  }
  EXPECT_LT(errors[1], 0.05);
  EXPECT_GT(errors[0] / errors[1], 3);
}

// A weak motor: 4.905 N m would hold a level rod of 1 kg and 1 m. x = (angle from upright, its rate).
PlanarControlProblem pendulum() {
  return {.rate = [](const Vector2d& x,
                     double u) { return Vector2d(x[1], 9.81 * std::sin(x[0]) - 0.1 * x[1] + u); },
          .cost = [](const Vector2d& x,
                     double u) { return 2 * (1 - std::cos(x[0])) + 0.05 * x[1] * x[1] + 0.02 * u * u; },
          .uMin = -3,
          .uMax = 3,
          .discount = 0.1};
}

ValueGridOptions pendulumOptions(int nodes) {
  return {.lower = {-M_PI, -10},
          .upper = {M_PI, 10},
          .nodes = {nodes, nodes},
          .isAngle = {1, 0},
          .controls = 13,
          .tolerance = 1e-5};
}

TEST(ValueGrid, SwingsThePendulumUp) {
  const PlanarControlProblem problem = pendulum();
  const ValueGrid grid(problem, pendulumOptions(101));
  ASSERT_TRUE(grid.isConverged()) << grid.message();
  EXPECT_NEAR(grid.value({M_PI, 2}), grid.value({-M_PI, 2}), 1e-12);
  EXPECT_NEAR(grid.value({0.7, -1}), grid.value({-0.7, 1}), 1e-2 * grid.value({0.7, -1}));
  Vector2d x(M_PI, 0);
  double cost = 0;
  int reversals = 0;
  double last = 0;
  for (int t = 0; t < 200; ++t) {  // 10 s
    const double u = grid.control(x);
    reversals += t < 100 && u * last < 0;
    last = u != 0 ? u : last;
    for (int i = 0; i < 50; ++i) {
      cost += 0.001 * std::exp(-0.1 * (0.05 * t + 0.001 * i)) * problem.cost(x, u);
      const Vector2d middle = x + 0.0005 * problem.rate(x, u);
      x += 0.001 * problem.rate(middle, u);
    }
  }
  EXPECT_GT(std::cos(x[0]), 0.99);
  EXPECT_LT(std::abs(x[1]), 0.2);
  EXPECT_GE(reversals, 2);  // too weak to lift it at once
  EXPECT_NEAR(cost, grid.value({M_PI, 0}), 0.1 * cost);
}

// Finer grids are closer by h^2 where the value is smooth. It jumps, from 0.2 to 3.4 close to upright, where
// the motor just fails to catch the rod; around that curve, which winds through all states, it only gets
// closer by about h^(1/2) in the mean square.
TEST(ValueGrid, ApproachesTheValueOfAFineGrid) {
  ValueGridOptions options = pendulumOptions(101);
  options.lower[1] = -8, options.upper[1] = 8, options.controls = 7;
  std::vector<ValueGrid> grids;
  for (const int nodes : {101, 201, 401}) {
    options.nodes.setConstant(nodes);
    grids.emplace_back(pendulum(), options);
  }
  // How many times smaller the root mean square of the differences becomes; of second order, four times.
  const auto factor = [&](auto isAmong) {
    double coarse = 0, fine = 0;
    for (int i = 0; i < 160; ++i)
      for (int j = 0; j < 160; ++j) {
        const Vector2d x(M_PI * ((i + 0.5) / 80 - 1), 8 * ((j + 0.5) / 80 - 1));
        if (!isAmong(x)) continue;
        coarse += std::pow(grids[0].value(x) - grids[1].value(x), 2);
        fine += std::pow(grids[1].value(x) - grids[2].value(x), 2);
      }
    return std::sqrt(coarse / fine);
  };
  // 400 states that come to rest upright when let go of, nearly; 765 that pass it and swing up from below.
  const double caught = factor(
      [](const Vector2d& x) { return std::abs(x[0]) < 1 && std::abs(x[1] + std::sqrt(9.81) * x[0]) < 0.4; });
  EXPECT_GT(caught, 3.5);
  EXPECT_LT(caught, 5);
  const double passing =
      factor([](const Vector2d& x) { return x[0] > -0.5 && x[0] < 1.5 && x[1] > 3.5 && x[1] < 5; });
  EXPECT_GT(passing, 3.5);
  EXPECT_LT(passing, 5);
  const double all = factor([](const Vector2d&) { return true; });
  EXPECT_GT(all, 1.2);
  EXPECT_LT(all, 2);
}

TEST(ValueGrid, SaysWhatLeavesTheRegion) {
  const PlanarControlProblem away{.rate = [](const Vector2d&, double u) { return Vector2d(1, u); },
                                  .cost = [](const Vector2d&, double) { return 1.; },
                                  .discount = 1};
  const ValueGrid grid(away, {.lower = {0, 0}, .upper = {1, 1}, .nodes = {5, 5}, .step = 0.1});
  EXPECT_NEAR(grid.value({0.5, 0.5}), 1, 1e-5);  // the integral of e^-t
  EXPECT_EQ(grid.leaving(), 5);
  EXPECT_THAT(grid.message(), HasSubstr("; from 5 nodes of 25 the best motion leaves the region"));
  EXPECT_THAT(
      ValueGrid(mass(), {.lower = {-1, -1}, .upper = {1, 1}, .nodes = {9, 9}, .maxSweeps = 1}).message(),
      HasSubstr("not converged after 1 sweeps"));
}

TEST(ValueGrid, RefusesWhatIsNoProblem) {
  const auto made = [](auto change) {
    PlanarControlProblem problem = mass();
    ValueGridOptions options = massOptions(5);
    change(problem, options);
    return ValueGrid(problem, options);
  };
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.cost = {}; }),
                   "value grid: found a function that is missing, wanted rate and cost");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.lower[1] = 3; }),
                   "value grid: region of state 1: found 3 to 2, wanted a lower number first");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.nodes[0] = 2; }),
                   "value grid: nodes along state 0: found 2, wanted at least 3");
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.uMin = 5; }),
                   "value grid: controls: found 5 to 4, wanted a lower number first");
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.uMin = -HUGE_VAL; }), "value grid: uMin: found -inf");
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.uMax = HUGE_VAL; }), "value grid: uMax: found inf");
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.discount = -1; }), "value grid: discount: found -1");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.controls = 1; }),
                   "value grid: controls: found 1, wanted at least 2");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.step = 0; }), "value grid: step: found 0 s");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.tolerance = 0; }), "value grid: tolerance: found 0");
  EXPECT_REX_ERROR(made([](auto&, auto& o) { o.maxSweeps = 0; }),
                   "value grid: sweeps: found 0, wanted at least 1");
  EXPECT_REX_ERROR(made([](auto& p, auto&) { p.cost = [](const Vector2d& x, double) { return x[0]; }; }),
                   "value grid: state (-2, -2), control -4: found (-2.");
}

}  // namespace rex::value_grid_test
