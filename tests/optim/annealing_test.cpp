#include <cmath>

#include <gtest/gtest.h>

#include "optim/stochastic_search.h"
#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::annealing_test {

using Eigen::VectorXd;

// At one temperature T a long walk has Boltzmann's distribution: for x^2 / 2, a normal of variance T.
TEST(Annealing, WalksAsBoltzmannSays) {
  for (const double temperature : {0.5, 4.}) {
    constexpr int kWalks = 4000;
    double squares = 0, fourth = 0;
    for (int seed = 0; seed < kWalks; ++seed) {
      Rng rng(static_cast<std::uint64_t>(seed));
      const AnnealingResult walk =
          minimizeByAnnealing([](const VectorArg& x) { return x[0] * x[0] / 2; }, VectorXd::Ones(1), rng,
                              {.deviation = 2 * std::sqrt(temperature),
                               .firstTemperature = temperature,
                               .lastTemperature = temperature,
                               .maxEvaluations = 60});
      squares += walk.last[0] * walk.last[0] / kWalks;
      fourth += std::pow(walk.last[0], 4) / kWalks;
    }
    EXPECT_NEAR(squares / temperature, 1, 0.1);  // five deviations
    EXPECT_NEAR(fourth / (3 * temperature * temperature), 1, 0.25);
  }
}

TEST(Annealing, LeavesHollowsThatCoolingTooFastDoesNot) {
  const TestFunction& rastrigin = testFunction("rastrigin");
  const auto successes = [&](double firstTemperature) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Rng rng(seed);
      const AnnealingResult result = minimizeByAnnealing(rastrigin.value, rng.uniformVector(2, 1, 5), rng,
                                                         {.deviation = 0.25,
                                                          .firstTemperature = firstTemperature,
                                                          .lastTemperature = 1e-3,
                                                          .maxEvaluations = 20'000,
                                                          .target = rastrigin.target});
      count += result.status == SearchStatus::kTargetReached;
    }
    return count;
  };
  EXPECT_GE(successes(30), 17);
  EXPECT_LE(successes(2e-3), 3);
}

// Values 0 and 1 in turn: a 0 is always taken, so that each 1 is a step up by one.
TEST(Annealing, CoolsByTheSameFactorAtEachStep) {
  constexpr int kSteps = 20'000;
  constexpr double kFirst = 10, kLast = 0.01;
  long calls = 0;
  const Objective f = [&](const VectorArg&) { return static_cast<double>(calls++ % 2); };
  Rng rng(3);
  const AnnealingResult result =
      minimizeByAnnealing(f, VectorXd::Zero(1), rng,
                          {.firstTemperature = kFirst, .lastTemperature = kLast, .maxEvaluations = kSteps});
  double expected = kSteps / 2. - 1;  // the zeros after the start
  for (int i = 1; i < kSteps; i += 2)
    expected += std::exp(-1 / (kFirst * std::pow(kLast / kFirst, i / static_cast<double>(kSteps))));
  EXPECT_NEAR(static_cast<double>(result.accepted), expected, 250);  // more than five deviations
}

TEST(Annealing, TellsHowItWent) {
  Rng rng(1);
  const AnnealingResult result = minimizeByAnnealing(testFunction("sphere").value, VectorXd::Ones(3), rng,
                                                     {.deviation = 0.1, .maxEvaluations = 5000});
  EXPECT_EQ(result.status, SearchStatus::kBudgetSpent);
  EXPECT_EQ(result.evaluations, 5000);
  EXPECT_EQ(result.iterations, 4999);
  EXPECT_GT(result.accepted, 500);
  EXPECT_LT(result.accepted, 4999);
  EXPECT_LT(result.value, 0.05);
  EXPECT_LE(result.value, result.last.squaredNorm());
  EXPECT_EQ(result.value, result.x.squaredNorm());
  Rng again(1);
  EXPECT_EQ(minimizeByAnnealing(testFunction("sphere").value, VectorXd::Ones(3), again,
                                {.deviation = 0.1, .maxEvaluations = 5000})
                .last,
            result.last);
}

TEST(Annealing, NeverStepsWhereThereIsNoValue) {
  const Objective f = [](const VectorArg& x) { return x[0] < 0 ? std::nan("") : x[0]; };
  Rng rng(2);
  const AnnealingResult result = minimizeByAnnealing(f, VectorXd::Ones(1), rng, {.maxEvaluations = 1000});
  EXPECT_GE(result.last[0], 0);
  EXPECT_GT(result.invalid, 0);
  const AnnealingResult from = minimizeByAnnealing(f, -3 * VectorXd::Ones(1), rng, {.maxEvaluations = 1000});
  EXPECT_GE(from.last[0], 0);  // where it starts, any step is as good as none
}

TEST(Annealing, SaysWhatIsWrong) {
  Rng rng(0);
  const auto run = [&](const AnnealingOptions& options, const VectorXd& start = VectorXd::Ones(2)) {
    return minimizeByAnnealing(testFunction("sphere").value, start, rng, options);
  };
  EXPECT_REX_ERROR(run({}, VectorXd()), "annealing: coordinates of the start: found 0, wanted at least 1");
  EXPECT_REX_ERROR(run({.deviation = -1}),
                   "annealing: deviation of steps: found -1, wanted a positive, finite number");
  EXPECT_REX_ERROR(run({.firstTemperature = 0}),
                   "annealing: first temperature: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(run({.lastTemperature = 11}),
                   "annealing: last temperature: found 11, wanted a positive number, at");
  EXPECT_REX_ERROR(run({.lastTemperature = 0}), "annealing: last temperature: found 0");
  EXPECT_REX_ERROR(run({.maxEvaluations = 0}),
                   "annealing: budget of evaluations: found 0, wanted at least 1");
}

}  // namespace rex::annealing_test
