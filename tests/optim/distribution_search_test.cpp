#include <cmath>

#include <gtest/gtest.h>

#include "optim/stochastic_search.h"
#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::distribution_search_test {

using Eigen::VectorXd;

TEST(DistributionSearch, FindsTheMinimumInsideItsFirstSamples) {
  for (const char* name : {"sphere", "ellipsoid", "rastrigin"})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const TestFunction& function = testFunction(name);
      Rng rng(seed);
      const SearchResult result = minimizeByDistribution(batched(function.value), rng.uniformVector(5, -1, 1),
                                                         5, rng, {.lambda = 400, .target = function.target});
      EXPECT_EQ(result.status, SearchStatus::kTargetReached) << name << ": " << result.message;
    }
}

// Of normal samples the lowest share p along x_1 has the mean -phi(z) / p and the variance 1 - z phi(z) / p -
// mean^2 with z the p-quantile's magnitude; the other coordinates keep theirs. So deviations on a slope
// shrink, and the mean comes to rest after a finite way: for p = .3, phi(z) = .3477, mean 1.159, deviation
// .515 per generation.
TEST(DistributionSearch, ShrinksOnASlopeAsTheNormalDistributionSays) {
  double last = 0;
  const BatchObjective slope = [&](const MatrixArg& X, Eigen::Ref<VectorXd> values) {
    values = X.row(0).transpose();
    last = values.mean();
  };
  Rng rng(4);
  const SearchResult result = minimizeByDistribution(slope, VectorXd::Zero(1), 1, rng, {.lambda = 20'000});
  EXPECT_EQ(result.status, SearchStatus::kSmallSteps);
  EXPECT_NEAR(last, -1.159 / (1 - 0.515), 0.05);
  const BatchObjective flat = [](const MatrixArg&, Eigen::Ref<VectorXd> values) { values.setZero(); };
  EXPECT_EQ(minimizeByDistribution(flat, VectorXd::Zero(2), 1, rng, {.maxEvaluations = 10'000}).status,
            SearchStatus::kBudgetSpent);
}

TEST(DistributionSearch, LearnsTheDirectionOfAValleyOnlyWithAFullCovariance) {
  const BatchObjective valley = batched([](const VectorArg& x) {
    return 1e4 * (x[0] - x[1]) * (x[0] - x[1]) + (x[0] + x[1] - 2) * (x[0] + x[1] - 2);
  });
  long evaluations[2];
  for (const bool full : {false, true}) {
    Rng rng(5);
    const SearchResult result =
        minimizeByDistribution(valley, VectorXd::Zero(2), 2, rng, {.fullCovariance = full, .target = 1e-8});
    if (full) {
      EXPECT_EQ(result.status, SearchStatus::kTargetReached);
    } else {
      EXPECT_NE(result.status, SearchStatus::kTargetReached);
    }
    evaluations[full] = result.evaluations;
  }
  EXPECT_LT(evaluations[1], 10'000);
}

TEST(DistributionSearch, RefusesOptionsOutOfRangeAndCountsInvalidPoints) {
  const BatchObjective f = batched(testFunction("sphere").value);
  Rng rng(1);
  EXPECT_REX_ERROR((void)minimizeByDistribution(f, VectorXd::Ones(2), 1, rng, {.lambda = 3}),
                   "distribution search: lambda: found 3, wanted 4 to 1000000");
  EXPECT_REX_ERROR((void)minimizeByDistribution(f, VectorXd::Ones(2), 1, rng, {.share = 1}),
                   "distribution search: share: found 1, wanted a number between 0 and 1");
  EXPECT_REX_ERROR((void)minimizeByDistribution(f, VectorXd::Ones(2), 1, rng, {.smallestStep = 0}),
                   "distribution search: smallest step: found 0");
  EXPECT_REX_ERROR((void)minimizeByDistribution(f, VectorXd::Ones(2), -1, rng), "distribution search: ");
  const BatchObjective half =
      batched([](const VectorArg& x) { return x[0] < 0 ? std::nan("") : (x[0] - 0.5) * (x[0] - 0.5); });
  const SearchResult result = minimizeByDistribution(half, VectorXd::Ones(1), 1, rng, {.target = 1e-3});
  EXPECT_EQ(result.status, SearchStatus::kTargetReached);
  EXPECT_GT(result.invalid, 0);
}

}  // namespace rex::distribution_search_test
