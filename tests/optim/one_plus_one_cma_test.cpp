#include <cmath>

#include <gtest/gtest.h>

#include "optim/cma_search.h"
#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::one_plus_one_cma_test {

using Eigen::VectorXd;

// The paper's figures: on the sphere the expected progress is linear, about 6 n evaluations per factor of e
// in the distance; on the ellipsoid the covariance makes it as fast once it is learnt.
TEST(OnePlusOneCma, GoesDownAtTheRateOfTheory) {
  for (const int n : {5, 10, 20}) {
    Rng rng(7);
    const SearchResult result =
        minimizeByOnePlusOne(testFunction("sphere").value, VectorXd::Ones(n), 1, rng, {.target = 1e-12});
    EXPECT_EQ(result.status, SearchStatus::kTargetReached);
    const double factors = 0.5 * std::log(n / 1e-12);
    EXPECT_NEAR(static_cast<double>(result.evaluations) / (n * factors), 6, 2.5) << n;
  }
}

TEST(OnePlusOneCma, LearnsTheShapeOfTheFunction) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng(seed);
    const SearchResult result =
        minimizeByOnePlusOne(testFunction("ellipsoid").value, VectorXd::Ones(5), 1, rng, {.target = 1e-10});
    EXPECT_EQ(result.status, SearchStatus::kTargetReached) << result.message;
    EXPECT_LT(result.evaluations, 6000);
    const SearchResult valley = minimizeByOnePlusOne(testFunction("rosenbrock").value, VectorXd::Zero(5), 0.5,
                                                     rng, {.target = 1e-10});
    EXPECT_EQ(valley.status, SearchStatus::kTargetReached) << valley.message;
  }
}

TEST(OnePlusOneCma, EndsAndRefuses) {
  Rng rng(1);
  const Objective f = testFunction("sphere").value;
  EXPECT_EQ(minimizeByOnePlusOne(f, VectorXd::Ones(3), 1, rng, {.maxEvaluations = 7}).evaluations, 7);
  EXPECT_EQ(
      minimizeByOnePlusOne([](const VectorArg&) { return std::nan(""); }, VectorXd::Ones(2), 1, rng).status,
      SearchStatus::kSmallSteps);
  EXPECT_EQ(
      minimizeByOnePlusOne([](const VectorArg& x) { return -std::abs(x[0]); }, VectorXd::Ones(1), 1, rng)
          .status,
      SearchStatus::kDiverged);
  EXPECT_REX_ERROR((void)minimizeByOnePlusOne(f, VectorXd::Ones(2), 0, rng), "(1+1)-CMA: ");
  EXPECT_REX_ERROR((void)minimizeByOnePlusOne(f, VectorXd::Ones(2), 1, rng, {.smallestStep = 0}),
                   "(1+1)-CMA: smallest step: found 0");
}

}  // namespace rex::one_plus_one_cma_test
