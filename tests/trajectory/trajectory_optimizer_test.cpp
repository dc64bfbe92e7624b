#include "trajectory/trajectory_optimizer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "trajectory/banded_system_internal.h"
#include "trajectory/counted_number.h"
#include "trajectory/motion_terms.h"

namespace rex::trajectory_optimizer_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd point(double x, double y) { return Eigen::Vector2d(x, y); }

// From rest at `from` to rest at `to` in one second.
TrajectoryProblem restToRest(const VectorXd& from, const VectorXd& to, int steps,
                             std::vector<TrajectoryTerm> terms = {}) {
  terms.push_back(accelerationTerm());
  for (TrajectoryTerm& term : restTerms(to, steps)) terms.push_back(std::move(term));
  return {terms, from.replicate(1, 2), steps, 1. / steps};
}

// Stays outside a disc in the plane: a smooth, curved constraint.
TrajectoryTerm outsideDisc(const VectorXd& centre, double radius) {
  return {.name = "disc",
          .kind = TermKind::kInequality,
          .function = [=](const TrajectoryWindow& at, FunctionValue& value) {
            value.y.setConstant(1, radius * radius - (at.X.col(0) - centre).squaredNorm());
            value.J = -2 * (at.X.col(0) - centre).transpose();
          }};
}

// With T accelerations a_t whose sum is zero and whose weighted sum moves by one, the least sum of squares is
// 12 / T (T^2 - 1); times 1 / tau^3 = T^3 it is 12 T^2 / (T^2 - 1). The integral of the cubic is 12.
TEST(TrajectoryOptimizer, FindsTheLeastAccelerationFromRestToRest) {
  for (const int T : {3, 10, 100}) {
    const TrajectoryProblem problem = restToRest(VectorXd::Zero(1), VectorXd::Ones(1), T);
    const TrajectoryResult result =
        optimizeTrajectory(problem, MatrixXd::Zero(1, T), {.tolerance = 1e-12, .penalty = 1e3});
    EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved) << result.solution.message;
    const double squared = static_cast<double>(T) * T;
    EXPECT_NEAR(result.solution.cost, 12 * squared / (squared - 1), 1e-10) << "T = " << T;
  }
}

// The same problem, written down as one dense matrix and solved by the dense solver.
TEST(TrajectoryOptimizer, AgreesWithADenseSolution) {
  const int T = 12;
  const VectorXd from = point(0, 0), to = point(1, 0), centre = point(0.5, -0.05);
  const TrajectoryProblem problem = restToRest(from, to, T, {outsideDisc(centre, 0.2)});
  const MatrixXd start = straightTrajectory(from, to, T) + MatrixXd::Constant(2, T, 0.01);
  const auto at = [&](const VectorArg& x, int t, int i) { return t < 0 ? from[i] : x[2 * t + i]; };
  const ConstrainedProblem dense{.residuals =
                                     [&](const VectorArg& x) {
                                       FunctionValue value{VectorXd(2 * T), MatrixXd::Zero(2 * T, 2 * T)};
                                       const double scale = std::pow(T, 1.5);
                                       for (int t = 0; t < T; ++t) {
                                         for (int i = 0; i < 2; ++i) {
                                           value.y[2 * t + i] =
                                               scale * (at(x, t, i) - 2 * at(x, t - 1, i) + at(x, t - 2, i));
                                           for (int j = 0; j <= std::min(t, 2); ++j)
                                             value.J(2 * t + i, 2 * (t - j) + i) = scale * (j == 1 ? -2 : 1);
                                         }
                                       }
                                       return value;
                                     },
                                 .inequalities =
                                     [&](const VectorArg& x) {
                                       FunctionValue value{VectorXd(T), MatrixXd::Zero(T, 2 * T)};
                                       for (int t = 0; t < T; ++t) {
                                         const Eigen::Vector2d away = x.segment<2>(2 * t) - centre;
                                         value.y[t] = 0.04 - away.squaredNorm();
                                         value.J.block<1, 2>(t, 2 * t) = -2 * away.transpose();
                                       }
                                       return value;
                                     },
                                 .equalities =
                                     [&](const VectorArg& x) {
                                       FunctionValue value{VectorXd(4), MatrixXd::Zero(4, 2 * T)};
                                       value.y << x.tail<2>() - to, x.tail<2>() - x.segment<2>(2 * T - 4);
                                       value.J.topRightCorner<2, 2>().setIdentity();
                                       value.J.bottomRightCorner<2, 2>().setIdentity();
                                       value.J.block<2, 2>(2, 2 * T - 4) = -MatrixXd::Identity(2, 2);
                                       return value;
                                     }};
  for (const ConstraintMethod method : {ConstraintMethod::kSquaredPenalty, ConstraintMethod::kLogBarrier,
                                        ConstraintMethod::kAugmentedLagrangian}) {
    SCOPED_TRACE(toString(method));
    const TrajectoryResult banded = optimizeTrajectory(problem, start, {.method = method});
    const ConstrainedResult other = solveConstrained(dense, VectorXd(start.reshaped()));
    EXPECT_EQ(banded.solution.status, ConstrainedStatus::kSolved) << banded.solution.message;
    EXPECT_EQ(other.status, ConstrainedStatus::kSolved) << other.message;
    EXPECT_NEAR(banded.solution.cost, other.cost, 1e-4);
    EXPECT_LT((banded.X.reshaped() - other.x).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_GT(other.cost, 13);  // the disc is in the way
  }
}

TEST(TrajectoryOptimizer, GoesThroughWaypointsWithinLimits) {
  const int T = 30;
  const VectorXd from = point(0, 0), to = point(1, 1);
  TrajectoryTerm via = as(TermKind::kEquality, at(postureTerm(point(1, 0)), 14));
  via.name = "via";
  const TrajectoryProblem problem =
      restToRest(from, to, T, {via, limitsTerm(point(-0.01, -0.02), point(1.01, 1.02))});
  const TrajectoryResult result = optimizeTrajectory(problem, straightTrajectory(from, to, T));
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved) << result.solution.message;
  EXPECT_LT((result.X.col(14) - point(1, 0)).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT(result.X.row(0).maxCoeff(), 1.01 + 1e-8);
  EXPECT_GT(result.X.row(1).minCoeff(), -0.02 - 1e-8);
  EXPECT_GT(result.X.row(0).maxCoeff(), 1.01 - 1e-4);  // it would have gone further
}

TEST(TrajectoryOptimizer, NamesTheConstraintAndTheStepThatCannotBeMet) {
  const int T = 10;
  TrajectoryTerm via = as(TermKind::kEquality, at(postureTerm(point(0.5, 3)), 4));
  via.name = "via";
  const TrajectoryProblem problem =
      restToRest(point(0, 0), point(1, 0), T, {via, limitsTerm(point(-1, -1), point(2, 2))});
  const TrajectoryResult result = optimizeTrajectory(problem, MatrixXd::Zero(2, T));
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kInfeasible) << result.solution.message;
  EXPECT_NEAR(result.solution.violation, 0.5, 1e-2);
  EXPECT_THAT(result.solution.message, testing::AnyOf(testing::HasSubstr("'via' at step 4, row 1"),
                                                      testing::HasSubstr("'limits' at step 4, row 3")));
}

TEST(TrajectoryOptimizer, StartsWarm) {
  const int T = 20;
  const VectorXd from = point(0, 0), to = point(1, 0);
  const TrajectoryProblem problem = restToRest(from, to, T, {outsideDisc(point(0.5, -0.05), 0.2)});
  const MatrixXd start = straightTrajectory(from, to, T) + MatrixXd::Constant(2, T, 0.01);
  const ConstrainedResult cold = optimizeTrajectory(problem, start).solution;
  const TrajectoryResult warm = optimizeTrajectory(problem, cold.x.reshaped(2, T),
                                                   {.penalty = cold.penalty,
                                                    .inequalityMultipliers = cold.inequalityMultipliers,
                                                    .equalityMultipliers = cold.equalityMultipliers});
  EXPECT_EQ(cold.status, ConstrainedStatus::kSolved) << cold.message;
  EXPECT_EQ(warm.solution.status, ConstrainedStatus::kSolved) << warm.solution.message;
  EXPECT_LT(warm.solution.iterations, cold.iterations / 3);
  EXPECT_NEAR(warm.solution.cost, cold.cost, 1e-6);
}

// Products, quotients and roots of assembling, factoring and solving, and what is stored.
struct Work {
  long count;
  std::size_t stored;
};

Work workOf(int n, int steps) {
  const VectorXd from = VectorXd::Zero(n), to = VectorXd::Ones(n);
  const TrajectoryProblem problem =
      restToRest(from, to, steps, {limitsTerm(VectorXd::Constant(n, -1), VectorXd::Constant(n, 2))});
  internal::BandedSystem system(problem);
  ConstrainedValues values;
  system.evaluate(VectorXd(straightTrajectory(from, to, steps).reshaped()), values);
  const ConstraintWeights weights{.g = VectorXd::Ones(values.g.size()),
                                  .h = VectorXd::Ones(values.h.size()),
                                  .gg = VectorXd::Ones(values.g.size()),
                                  .hh = VectorXd::Ones(values.h.size())};
  auto A = system.emptyBand<Counted>(), factor = A;
  A.setZero();
  Counted::count = 0;
  internal::BandRow<Counted> room;
  system.addSquares(weights, A, room);
  EXPECT_TRUE(factor.factor(A, Counted(0)));
  std::vector<Counted> b(static_cast<std::size_t>(n * steps), Counted(1));
  factor.solveInPlace(b);
  return {Counted::count, A.stored()};
}

TEST(TrajectoryOptimizer, TakesWorkInProportionToTheSteps) {
  const Work a = workOf(7, 100), b = workOf(7, 200), c = workOf(7, 400);
  EXPECT_EQ(c.count - b.count, 2 * (b.count - a.count));  // exactly linear, but for both ends
  EXPECT_LT(static_cast<double>(c.count) / static_cast<double>(a.count), 4.1);
  EXPECT_EQ(a.stored, 100u * 7 * 21);
  EXPECT_EQ(c.stored, 4 * a.stored);
  // Each column of the factor takes 21 * 22 / 2 products, solving 2 * 21.
  EXPECT_NEAR(static_cast<double>(b.count - a.count) / 700, 21 * 22 / 2 + 2 * 21, 30);
}

#ifndef __SANITIZE_ADDRESS__
TEST(TrajectoryOptimizer, AllocatesNothingWhileItIterates) {
  const int T = 40;
  const VectorXd from = point(0, 0), to = point(1, 0);
  const TrajectoryProblem problem =
      restToRest(from, to, T, {outsideDisc(point(0.5, -0.05), 0.2), limitsTerm(point(-1, -1), point(2, 2))});
  const MatrixXd start = straightTrajectory(from, to, T) + MatrixXd::Constant(2, T, 0.01);
  const auto allocationsOf = [&](int iterations) {
    const long before = allocations();
    const TrajectoryResult result = optimizeTrajectory(problem, start, {.maxIterations = iterations});
    EXPECT_EQ(result.solution.status, ConstrainedStatus::kBudgetSpent);
    return allocations() - before;
  };
  EXPECT_GT(allocationsOf(1), 0);
  EXPECT_EQ(allocationsOf(15), allocationsOf(1));
}
#endif

TEST(TrajectoryOptimizer, MakesStraightStarts) {
  const MatrixXd X = straightTrajectory(point(0, 2), point(4, 0), 4);
  EXPECT_EQ(X, (MatrixXd(2, 4) << 1, 2, 3, 4, 1.5, 1, 0.5, 0).finished());
  EXPECT_REX_ERROR(straightTrajectory(point(0, 2), VectorXd::Ones(3), 4),
                   "end of a straight trajectory: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(straightTrajectory(point(0, 2), point(0, 2), 0),
                   "steps of a trajectory: found 0, wanted at least 1");
}

TEST(TrajectoryOptimizer, FindsTheShortestTimeOfAStep) {
  const MatrixXd path = (MatrixXd(2, 4) << 0, 1, 3, 3, 0, 0, 0, -1).finished();
  EXPECT_EQ(shortestTau(path, point(4, 4), {}), 0.5);
  EXPECT_EQ(shortestTau(path, {}, point(8, 1)), 1);
  EXPECT_EQ(shortestTau(path, point(4, 0.5), point(8, 1)), 2);
  EXPECT_EQ(shortestTau(path, {}, {}), 0);
  EXPECT_EQ(shortestTau(path.leftCols(1), point(1, 1), point(1, 1)), 0);
  EXPECT_REX_ERROR(shortestTau(path, VectorXd::Ones(3), {}),
                   "velocity limits: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(shortestTau(path, {}, point(1, 0)),
                   "acceleration limits: found 0, wanted a positive number, or infinity");
}

TEST(TrajectoryOptimizer, SaysWhatIsWrong) {
  const TrajectoryProblem problem = restToRest(point(0, 0), point(1, 0), 5);
  EXPECT_REX_ERROR(optimizeTrajectory(problem, MatrixXd::Zero(2, 4)),
                   "start of a trajectory: found 2 x 4, wanted 2 x 5");
  const auto with = [](const TermFunction& function) {
    return TrajectoryProblem({{.name = "odd", .function = function}}, VectorXd::Zero(2), 3);
  };
  EXPECT_REX_ERROR(optimizeTrajectory(with([](const TrajectoryWindow&, FunctionValue& value) {
                                        value = {VectorXd::Ones(1), MatrixXd::Ones(1, 3)};
                                      }),
                                      MatrixXd::Zero(2, 3)),
                   "Jacobian of term 'odd' at step 0: found 1 x 3, wanted 1 x 2");
  int calls = 0;
  EXPECT_REX_ERROR(optimizeTrajectory(with([&](const TrajectoryWindow&, FunctionValue& value) {
                                        const int d = ++calls == 5 ? 2 : 1;
                                        value = {VectorXd::Ones(d), MatrixXd::Ones(d, 2)};
                                      }),
                                      MatrixXd::Zero(2, 3)),
                   "value of term 'odd' at step 1: found a vector of size 2, wanted size 1");
}

}  // namespace rex::trajectory_optimizer_test
