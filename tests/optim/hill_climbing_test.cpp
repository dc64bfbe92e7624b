#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "optim/stochastic_search.h"
#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::hill_climbing_test {

using Eigen::VectorXd;

SearchResult climb(bool byChance, const Objective& f, const VectorXd& start,
                   const HillClimbingOptions& options = {}) {
  Rng rng(1);
  return byChance ? climbByChance(f, start, rng, options) : climbToBestNeighbour(batched(f), start, options);
}

TEST(HillClimbing, EndsInTheNextHollow) {
  const TestFunction& rastrigin = testFunction("rastrigin");
  const auto gradientAt = [&](const VectorXd& x) {
    return numericJacobian([&](const VectorXd& at) { return VectorXd::Constant(1, rastrigin.value(at)); }, x);
  };
  for (const bool byChance : {false, true}) {
    const SearchResult result = climb(byChance, rastrigin.value, Eigen::Vector2d(3.1, 1.9), {.step = 0.1});
    EXPECT_EQ(result.status, SearchStatus::kSmallSteps) << result.message;
    EXPECT_NEAR(result.x[0], 2.9849, 1e-4);  // the local minima nearest to whole numbers
    EXPECT_NEAR(result.x[1], 1.9899, 1e-4);
    EXPECT_LT(gradientAt(result.x).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_EQ(result.value, rastrigin.value(result.x));
  }
}

TEST(HillClimbing, ReachesTheFootOfABowl) {
  for (const bool byChance : {false, true}) {
    const SearchResult result =
        climb(byChance, testFunction("sphere").value, VectorXd::LinSpaced(5, -1.3, 2), {.target = 1e-12});
    EXPECT_EQ(result.status, SearchStatus::kTargetReached) << result.message;
    EXPECT_LE(result.x.squaredNorm(), 1e-12);
  }
}

TEST(HillClimbing, TakesTheBestNeighbour) {
  long batches = 0;
  const BatchObjective f = [&](const MatrixArg& X, Eigen::Ref<VectorXd> values) {
    ++batches;
    values = (X.row(0).array().abs() + 3 * X.row(1).array().abs()).matrix().transpose();
  };
  const SearchResult result = climbToBestNeighbour(f, Eigen::Vector2d(2, 1), {.maxEvaluations = 5});
  EXPECT_EQ(result.x, Eigen::VectorXd(Eigen::Vector2d(2, 0)));  // steeper than the other axis
  EXPECT_EQ(result.evaluations, 5);
  EXPECT_EQ(batches, 2);
  EXPECT_EQ(result.status, SearchStatus::kBudgetSpent);
}

TEST(HillClimbing, LeavesOutWhatHasNoValue) {
  const Objective f = [](const VectorArg& x) { return x[0] < 1 ? std::nan("") : x[0]; };
  for (const bool byChance : {false, true}) {
    const SearchResult result = climb(byChance, f, VectorXd::Constant(1, 3.3));
    EXPECT_EQ(result.status, SearchStatus::kSmallSteps);
    EXPECT_NEAR(result.value, 1, 1e-6);
    EXPECT_GT(result.invalid, 0);
  }
}

TEST(HillClimbing, SaysWhatIsWrong) {
  const auto expect = [](const HillClimbingOptions& options, const char* text) {
    for (const bool byChance : {false, true})
      EXPECT_REX_ERROR(climb(byChance, testFunction("sphere").value, VectorXd::Ones(2), options), text);
  };
  expect({.step = 0}, "hill climbing: deviation of steps: found 0");
  expect({.smallestStep = 0}, "hill climbing: smallest step: found 0, wanted a positive, finite number");
  expect({.smallestStep = HUGE_VAL}, "hill climbing: smallest step: found inf");
  expect({.patience = 0}, "hill climbing: patience: found 0, wanted at least 1");
  expect({.maxEvaluations = 0}, "hill climbing: budget of evaluations: found 0");
  expect({.target = std::nan("")}, "hill climbing: target: found nan");
}

}  // namespace rex::hill_climbing_test
