#include "optim/simplex_search.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::simplex_search_test {

using Eigen::VectorXd;

TEST(SimplexSearch, FindsMinimaOfFewDimensions) {
  for (const char* name : {"sphere", "ellipsoid", "rosenbrock"})
    for (const int n : {2, 4, 8}) {
      const TestFunction& function = testFunction(name);
      const SearchResult result =
          minimizeBySimplex(function.value, VectorXd::Constant(n, 0.5 * (function.low + function.high)),
                            {.step = function.deviation, .target = function.target});
      EXPECT_EQ(result.status, SearchStatus::kTargetReached) << name << n << ": " << result.message;
      EXPECT_LT((result.x - VectorXd::Constant(n, function.minimizer)).cwiseAbs().maxCoeff(), 1e-3)
          << name << n;
    }
}

// Nelder and Mead report 195 evaluations from (-1.2, 1) to 3e-9.
TEST(SimplexSearch, NeedsAsManyEvaluationsAsThePaper) {
  const SearchResult result = minimizeBySimplex(testFunction("rosenbrock").value, Eigen::Vector2d(-1.2, 1),
                                                {.step = 1, .target = 3e-9});
  EXPECT_EQ(result.status, SearchStatus::kTargetReached);
  EXPECT_GT(result.evaluations, 100);
  EXPECT_LT(result.evaluations, 250);
}

// A linear map of x that takes the first simplex along changes nothing but x.
TEST(SimplexSearch, IsTheSameInOtherUnits) {
  const Objective f = testFunction("rosenbrock").value;
  const SearchResult plain = minimizeBySimplex(f, Eigen::Vector2d(-1, 1), {.step = 0.5, .target = 1e-9});
  const SearchResult scaled = minimizeBySimplex([&](const VectorArg& x) { return f(x / 8); },
                                                Eigen::Vector2d(-8, 8), {.step = 4, .target = 1e-9});
  EXPECT_EQ(plain.evaluations, scaled.evaluations);
  EXPECT_LT((8 * plain.x - scaled.x).norm(), 1e-9);
}

TEST(SimplexSearch, EndsWithinItsBudgetAndBesideInvalidPoints) {
  const Objective cliff = [](const VectorArg& x) { return x[0] < 0 ? std::nan("") : x.squaredNorm(); };
  const SearchResult result = minimizeBySimplex(cliff, Eigen::Vector2d(1, 1), {.target = 1e-8});
  EXPECT_EQ(result.status, SearchStatus::kTargetReached);
  EXPECT_GT(result.invalid, 0);
  for (const long budget : {1L, 2L, 7L, 50L}) {
    const SearchResult cut =
        minimizeBySimplex(testFunction("sphere").value, VectorXd::Ones(5), {.maxEvaluations = budget});
    EXPECT_LE(cut.evaluations, budget);
    EXPECT_EQ(cut.status, SearchStatus::kBudgetSpent);
  }
  EXPECT_EQ(minimizeBySimplex(testFunction("sphere").value, VectorXd::Ones(2)).status,
            SearchStatus::kSmallSteps);
}

TEST(SimplexSearch, RefusesOptionsOutOfRange) {
  const Objective f = testFunction("sphere").value;
  EXPECT_REX_ERROR((void)minimizeBySimplex(f, VectorXd::Ones(2), {.step = 0}), "simplex search: ");
  EXPECT_REX_ERROR((void)minimizeBySimplex(f, VectorXd::Ones(2), {.smallestStep = -1}),
                   "simplex search: smallest step: found -1");
  EXPECT_REX_ERROR((void)minimizeBySimplex(f, VectorXd()), "simplex search: ");
}

}  // namespace rex::simplex_search_test
