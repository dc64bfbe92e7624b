#include "optim/bayesian_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "optim/box_descent_internal.h"
#include "support/expect_error.h"

namespace rex::bayesian_search_test {

using Eigen::Vector2d;
using Eigen::VectorXd;

// A bounded valley: without bounds the minimum is (1, 1), with x0 <= 0.5 it is (0.5, 0.25).
TEST(BoxDescent, StopsAtTheBoundThatHoldsIt) {
  const internal::ValueAndGradient valley = [](const VectorXd& x, VectorXd& gradient) {
    const double rise = x[1] - x[0] * x[0];
    gradient = Vector2d(-400 * x[0] * rise - 2 * (1 - x[0]), 200 * rise);
    return 100 * rise * rise + (1 - x[0]) * (1 - x[0]);
  };
  const auto from = [&](double bound) {
    return internal::minimizeInBox(valley, Vector2d(-1.2, 1), Vector2d(-2, -2), Vector2d(bound, 2), 1e-8,
                                   1000);
  };
  EXPECT_LT((from(2).x - Vector2d(1, 1)).norm(), 1e-6);
  EXPECT_LT(from(2).evaluations, 200);
  EXPECT_EQ(from(0.5).x[0], 0.5);
  EXPECT_NEAR(from(0.5).x[1], 0.25, 1e-9);
  EXPECT_EQ(internal::minimizeInBox(valley, Vector2d(5, 5), Vector2d(-2, -2), Vector2d(2, 2), 1e-8, 1).x,
            Vector2d(2, 2));
}

// Against the integral over all values of f, by Simpson's rule.
TEST(BayesianSearch, ExpectedImprovementIsTheIntegral) {
  for (const double best : {-1., 0.4, 2.5}) {
    const double mean = 0.7, deviation = 0.6, low = mean - 12 * deviation;
    constexpr int kSteps = 20'000;
    const double step = (best - low) / kSteps;
    double integral = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double f = low + i * step, z = (f - mean) / deviation;
      integral += (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2) * (best - f) * std::exp(-z * z / 2);
    }
    integral *= step / 3 / (deviation * std::sqrt(2 * std::numbers::pi));
    EXPECT_NEAR(std::exp(logExpectedImprovement(mean, deviation, best)), integral, 1e-9);
  }
  // log(phi(z) + z Phi(z)) with sixty digits, by mpmath.
  for (const auto& [z, wanted] : {std::pair(4., 1.3862961474329033),
                                  {-3., -7.8696860596030285},
                                  {-29., -428.1570826442731},
                                  {-30., -457.724653760598},
                                  {-31., -488.29002339783721},
                                  {-200., -20011.515648259739}})
    EXPECT_NEAR(logExpectedImprovement(-2 * z, 2, 0) - std::log(2), wanted, 1e-10 * std::abs(wanted)) << z;
}

double branin(const VectorArg& x) {
  using std::numbers::pi;
  const double rise = x[1] - 5.1 / (4 * pi * pi) * x[0] * x[0] + 5 / pi * x[0] - 6;
  return rise * rise + 10 * (1 - 1 / (8 * pi)) * std::cos(x[0]) + 10;
}
constexpr double kBranin = 0.39788735772973816;

double hartmann6(const VectorArg& x) {
  const double A[4][6] = {{10, 3, 17, 3.5, 1.7, 8},
                          {0.05, 10, 17, 0.1, 8, 14},
                          {3, 3.5, 1.7, 10, 17, 8},
                          {17, 8, 0.05, 10, 0.1, 14}};
  const double P[4][6] = {{0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                          {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                          {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                          {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}};
  const double weights[4] = {1, 1.2, 3, 3.2};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    double exponent = 0;
    for (int j = 0; j < 6; ++j) exponent += A[i][j] * (x[j] - P[i][j]) * (x[j] - P[i][j]);
    sum -= weights[i] * std::exp(-exponent);
  }
  return sum;
}
constexpr double kHartmann6 = -3.322368011391339;

TEST(BayesianSearch, SolvesBraninInFewEvaluations) {
  for (const GaussianKernel kernel : {GaussianKernel::kSquaredExponential, GaussianKernel::kMatern52})
    for (const Acquisition acquisition : {Acquisition::kExpectedImprovement, Acquisition::kConfidenceBound})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Rng rng(seed);
        const SearchResult result =
            minimizeByBayes(branin, Vector2d(-5, 0), Vector2d(10, 15), rng,
                            {.kernel = kernel, .acquisition = acquisition, .maxEvaluations = 40});
        EXPECT_LT(result.value - kBranin, 1e-3) << seed;
        EXPECT_EQ(result.value, branin(result.x));
        EXPECT_EQ(result.evaluations, 40);
      }
}

TEST(BayesianSearch, SolvesHartmannInFewEvaluations) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Rng rng(seed);
    const SearchResult result = minimizeByBayes(
        hartmann6, VectorXd::Zero(6), VectorXd::Ones(6), rng,
        {.kernel = GaussianKernel::kSquaredExponential, .maxEvaluations = 80, .target = kHartmann6 + 0.01});
    // Its second minimum is worse by 0.12.
    EXPECT_LT(result.value - kHartmann6, 0.13) << seed << ": " << result.message;
    solved += result.status == SearchStatus::kTargetReached ? 1 : 0;
  }
  EXPECT_GE(solved, 3);
}

// Noise as large as a tenth of what f varies: the least observation would be luck.
TEST(BayesianSearch, AveragesNoise) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rng rng(seed), noise(seed + 100);
    const Objective f = [&](const VectorArg& x) {
      return (x - Vector2d(0.3, -0.2)).squaredNorm() + 0.1 * noise.normal();
    };
    const SearchResult result =
        minimizeByBayes(f, Vector2d(-1, -1), Vector2d(1, 1), rng, {.isNoisy = true, .maxEvaluations = 60});
    EXPECT_LT((result.x - Vector2d(0.3, -0.2)).norm(), 0.25) << seed;
    EXPECT_NEAR(result.value, 0, 0.1) << seed;
  }
}

BayesianSearch seen(const BayesianOptions& options) {
  BayesianSearch search(Vector2d(-5, 0), Vector2d(10, 15), options);
  Rng rng(3);
  for (int i = 0; i < 12; ++i) {
    const VectorXd x = search.next(rng);
    search.add(x, branin(x));
  }
  return search;
}

TEST(BayesianSearch, GoesWhereTheAcquisitionIsLargest) {
  for (const Acquisition acquisition : {Acquisition::kExpectedImprovement, Acquisition::kConfidenceBound}) {
    BayesianSearch search = seen({.acquisition = acquisition});
    const GaussianPrediction at = search.process()->predict(Vector2d(1, 2));
    EXPECT_NEAR(search.acquisition(Vector2d(1, 2)),
                acquisition == Acquisition::kConfidenceBound
                    ? 2 * at.deviation - at.mean
                    : logExpectedImprovement(at.mean, at.deviation, search.bestValue()),
                1e-12);
    Rng rng(4);
    const double found = search.acquisition(search.next(rng));
    double onGrid = -INFINITY;
    for (double x = -5; x <= 10; x += 0.1)
      for (double y = 0; y <= 15; y += 0.1) onGrid = std::max(onGrid, search.acquisition(Vector2d(x, y)));
    EXPECT_GT(found, onGrid - 1e-3 * std::abs(onGrid));
  }
}

TEST(BayesianSearch, BeginsOnALatinHypercube) {
  BayesianSearch search(Vector2d(0, -1), Vector2d(1, 1), {.firstSamples = 10});
  Rng rng(5);
  int visits[2][10] = {};
  for (int i = 0; i < 10; ++i) {
    const VectorXd x = search.next(rng);
    ++visits[0][static_cast<int>(10 * x[0])];
    ++visits[1][static_cast<int>(5 * (x[1] + 1))];
    search.add(x, x.sum());
  }
  for (const auto& coordinate : visits)
    for (const int count : coordinate) EXPECT_EQ(count, 1);
  ASSERT_TRUE(search.process());
  EXPECT_EQ(search.process()->points().cols(), 10);
}

TEST(BayesianSearch, StandsInvalidAndEqualValues) {
  Rng rng(6), same(6);
  const Objective half = [](const VectorArg& x) {
    return x[0] < 0 ? std::nan("") : (x - Vector2d(0.2, 0.1)).squaredNorm();
  };
  const BayesianOptions options{.maxEvaluations = 50, .target = 1e-3};
  const SearchResult result = minimizeByBayes(half, Vector2d(-1, -1), Vector2d(1, 1), rng, options);
  EXPECT_EQ(result.status, SearchStatus::kTargetReached) << result.message;
  EXPECT_GT(result.invalid, 0);
  EXPECT_EQ(minimizeByBayes(half, Vector2d(-1, -1), Vector2d(1, 1), same, options).x, result.x);
  const SearchResult nothing = minimizeByBayes([](const VectorArg&) { return std::nan(""); },
                                               Vector2d(-1, -1), Vector2d(1, 1), rng, {.maxEvaluations = 10});
  EXPECT_EQ(nothing.status, SearchStatus::kBudgetSpent);
  EXPECT_EQ(nothing.invalid, 10);
  EXPECT_EQ(minimizeByBayes([](const VectorArg&) { return 4.; }, Vector2d(-1, -1), Vector2d(1, 1), rng,
                            {.maxEvaluations = 12})
                .value,
            4);
}

TEST(BayesianSearch, RefusesWhatMakesNoSense) {
  const Vector2d low(0, 0), high(1, 1);
  EXPECT_REX_ERROR(BayesianSearch(VectorXd(0), VectorXd(0)), "coordinates of the box: found 0");
  EXPECT_REX_ERROR(BayesianSearch(low, VectorXd::Ones(3)), "Bayesian search: upper bounds");
  EXPECT_REX_ERROR(BayesianSearch(Vector2d(-INFINITY, 0), high), "lower bounds: number 0: found -inf");
  EXPECT_REX_ERROR(BayesianSearch(low, Vector2d(1, INFINITY)), "upper bounds: number 1: found inf");
  EXPECT_REX_ERROR(BayesianSearch(low, Vector2d(1, 0)),
                   "Bayesian search: upper bound: found 0, wanted more than the lower one, 0");
  EXPECT_REX_ERROR(BayesianSearch(low, high, {.confidence = 0}), "confidence: found 0");
  EXPECT_REX_ERROR(BayesianSearch(low, high, {.firstSamples = -1}), "first samples: found -1");
  EXPECT_REX_ERROR(BayesianSearch(low, high, {.firstSamples = 1}), "first samples: found 1");
  BayesianSearch search(low, high);
  EXPECT_REX_ERROR(search.acquisition(low),
                   "Bayesian search: acquisition: found 0 points, wanted 6 before there is a model");
  EXPECT_REX_ERROR(search.add(VectorXd::Ones(3), 0), "Bayesian search: point");
  EXPECT_REX_ERROR(search.add(Vector2d(2, 0), 0), "Bayesian search: point: found outside of the box");
  Rng rng(1);
  EXPECT_REX_ERROR(minimizeByBayes(branin, low, high, rng, {.maxEvaluations = 0}),
                   "budget of evaluations: found 0");
  EXPECT_REX_ERROR(minimizeByBayes(branin, low, high, rng, {.target = INFINITY}),
                   "target: found inf, wanted a number below infinity");
  EXPECT_REX_ERROR(logExpectedImprovement(0, 0, 1), "expected improvement: deviation: found 0");
}

}  // namespace rex::bayesian_search_test
