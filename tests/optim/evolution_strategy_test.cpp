#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "optim/stochastic_search.h"
#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::evolution_strategy_test {

using Eigen::VectorXd;

const BatchObjective& sphere() {
  static const BatchObjective f = batched(testFunction("sphere").value);
  return f;
}

// On a slope the mean moves by sigma times the mean of the mu lowest of lambda normals, which tables of order
// statistics give.
TEST(EvolutionStrategy, MovesAsOrderStatisticsSay) {
  const BatchObjective slope = [](const MatrixArg& X, Eigen::Ref<VectorXd> values) {
    values = X.row(0).transpose();
  };
  struct Case {
    int mu, lambda;
    double mean;
  };
  for (const Case& one :
       {Case{1, 2, 1 / std::sqrt(std::numbers::pi)}, Case{1, 4, 1.02938}, Case{2, 4, 0.66318}}) {
    constexpr int kGenerations = 20'000;
    constexpr double kDeviation = 0.5;
    // The mean is seen through the samples, which lie around it.
    double last = 0;
    const BatchObjective watched = [&](const MatrixArg& X, Eigen::Ref<VectorXd> values) {
      slope(X, values);
      last = values.mean();
    };
    Rng rng(1);
    const SearchResult result =
        minimizeByEvolution(watched, VectorXd::Zero(2), kDeviation, rng,
                            {.mu = one.mu,
                             .lambda = one.lambda,
                             .selfAdaptation = false,
                             .maxEvaluations = kGenerations * static_cast<long>(one.lambda)});
    EXPECT_EQ(result.iterations, kGenerations);
    EXPECT_NEAR(-last / (kDeviation * (kGenerations - 1)), one.mean, 0.02) << one.mu << " of " << one.lambda;
  }
}

// In one dimension a child lies at exp(z / sqrt(2)) times a normal: the variances of the logarithms add up,
// and that of |N(0, 1)| is pi^2 / 8.
TEST(EvolutionStrategy, VariesItsDeviations) {
  constexpr int kChildren = 40'000;
  std::vector<double> means, squares;
  const BatchObjective watched = [&](const MatrixArg& X, Eigen::Ref<VectorXd> values) {
    const Eigen::ArrayXXd logarithms = X.array().abs().log();
    means.push_back(logarithms.mean());
    squares.push_back((logarithms - means.back()).square().mean());
    values.setZero();  // any are as good as all
  };
  Rng rng(6);
  const SearchResult result =
      minimizeByEvolution(watched, VectorXd::Zero(1), 3, rng,
                          {.mu = kChildren / 4, .lambda = kChildren, .maxEvaluations = 2 * kChildren});
  EXPECT_EQ(result.iterations, 2);
  EXPECT_NEAR(squares[0], std::pow(std::numbers::pi, 2) / 8 + 0.5, 0.1);  // five deviations
  EXPECT_NEAR(means[1], means[0], 0.1);  // the parents' geometric mean is about the first deviation
}

TEST(EvolutionStrategy, AdaptsItsStepsToAnyScale) {
  const auto run = [](double scale, bool adapts) {
    Rng rng(2);
    return minimizeByEvolution(sphere(), VectorXd::Constant(10, scale), 1, rng,
                               {.mu = 5, .lambda = 35, .selfAdaptation = adapts, .target = 1e-20});
  };
  const SearchResult near = run(1, true), far = run(1e6, true), fixed = run(1, false);
  EXPECT_EQ(near.status, SearchStatus::kTargetReached);
  EXPECT_EQ(far.status, SearchStatus::kTargetReached);
  EXPECT_LT(far.evaluations, 4 * near.evaluations);  // linear in the logarithm of the distance
  EXPECT_EQ(fixed.status, SearchStatus::kBudgetSpent);
  EXPECT_GT(fixed.value, 1e-3);  // its steps stay as long as they were
}

// What it lacks: directions (slide 9:29).
TEST(EvolutionStrategy, IsSlowWhereCmaIsFast) {
  Rng rng(3);
  const SearchResult result =
      minimizeByEvolution(batched(testFunction("ellipsoid").value), VectorXd::Constant(8, 3), 1, rng,
                          {.mu = 5, .lambda = 35, .target = 1e-10, .maxEvaluations = 50'000});
  EXPECT_EQ(result.status, SearchStatus::kBudgetSpent);  // CMA-ES needs about 5000 evaluations
}

TEST(EvolutionStrategy, TellsWhyItEnds) {
  Rng rng(4);
  const SearchResult small = minimizeByEvolution(sphere(), VectorXd::Ones(3), 1, rng, {.smallestStep = 1e-3});
  EXPECT_EQ(small.status, SearchStatus::kSmallSteps);
  // A limit that a double does not hold is none that is missed.
  const SearchResult none = minimizeByEvolution(sphere(), VectorXd::Zero(3), 1e-200, rng,
                                                {.smallestStep = 1e-200, .maxEvaluations = 10'000'000});
  EXPECT_EQ(none.status, SearchStatus::kSmallSteps);
  const SearchResult diverged = minimizeByEvolution(batched([](const VectorArg& x) { return x[0]; }),
                                                    VectorXd::Ones(3), 1, rng, {.maxEvaluations = 1'000'000});
  EXPECT_EQ(diverged.status, SearchStatus::kDiverged);
  const SearchResult empty = minimizeByEvolution(batched([](const VectorArg&) { return std::nan(""); }),
                                                 VectorXd::Ones(3), 1, rng, {.maxEvaluations = 70});
  EXPECT_EQ(empty.status, SearchStatus::kBudgetSpent);
  EXPECT_EQ(empty.invalid, 70);  // ten generations of seven
  EXPECT_EQ(empty.x, VectorXd::Ones(3));
  Rng again(5), same(5);
  EXPECT_EQ(minimizeByEvolution(sphere(), VectorXd::Ones(3), 1, again).x,
            minimizeByEvolution(sphere(), VectorXd::Ones(3), 1, same).x);
}

TEST(EvolutionStrategy, SaysWhatIsWrong) {
  Rng rng(0);
  const auto run = [&](const VectorXd& start, double deviation,
                       const EvolutionStrategyOptions& options = {}) {
    return minimizeByEvolution(sphere(), start, deviation, rng, options);
  };
  const VectorXd one = VectorXd::Ones(2);
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  EXPECT_REX_ERROR(run(VectorXd(), 1),
                   "evolution strategy: coordinates of the start: found 0, wanted at least 1");
  EXPECT_REX_ERROR(run(nan * one, 1), "evolution strategy: start: number 0: found nan");
  EXPECT_REX_ERROR(run(one, 0),
                   "evolution strategy: deviation of steps: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(run(one, 1, {.target = nan}), "evolution strategy: target: found nan");
  EXPECT_REX_ERROR(run(one, 1, {.target = infinity}),
                   "evolution strategy: target: found inf, wanted a number below infinity");
  EXPECT_REX_ERROR(run(one, 1, {.maxEvaluations = 0}),
                   "evolution strategy: budget of evaluations: found 0, wanted at least 1");
  EXPECT_REX_ERROR(run(one, 1, {.smallestStep = 0}),
                   "evolution strategy: smallest step: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(run(one, 1, {.smallestStep = infinity}), "evolution strategy: smallest step: found inf");
  EXPECT_REX_ERROR(run(one, 1, {.mu = -1}), "evolution strategy: mu: found -1, wanted 1 to 100000, or 0");
  EXPECT_REX_ERROR(run(one, 1, {.mu = 4, .lambda = 4}),
                   "evolution strategy: lambda: found 4, wanted more than mu");
}

}  // namespace rex::evolution_strategy_test
