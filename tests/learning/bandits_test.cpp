#include "learning/bandits.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::bandits_test {

using Eigen::VectorXd;

const VectorXd kArms = (VectorXd(4) << 0.2, 0.5, 0.35, 0.6).finished();

// The mean regret of 20 runs after so many pulls.
double meanRegret(BanditRule rule, int pulls, double epsilon = 0.1) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    sum += playBandit(kArms, pulls, rule, rng, epsilon).regret.back();
  }
  return sum / 20;
}

TEST(Bandits, PullEachArmOnceBeforeTheyCompare) {
  Rng rng(1);
  for (const BanditRule rule : {BanditRule::kEpsilonGreedy, BanditRule::kUcb}) {
    const BanditRun run = playBandit(VectorXd::Constant(7, 0.5), 7, rule, rng);
    EXPECT_EQ(run.record.pulls, Eigen::VectorXi::Ones(7));
    EXPECT_EQ(run.regret, std::vector<double>(7, 0));
  }
}

// Theorem 1 of Auer, Cesa-Bianchi and Fischer bounds the expected regret after any number of pulls.
TEST(Bandits, UcbKeepsTheBoundOfItsPaper) {
  const Eigen::ArrayXd gaps = kArms.maxCoeff() - kArms.head(3).array();
  for (const int pulls : {100, 1000, 10000}) {
    const double bound = 8 * std::log(pulls) * gaps.inverse().sum() +
                         (1 + std::numbers::pi * std::numbers::pi / 3) * gaps.sum();
    EXPECT_LT(meanRegret(BanditRule::kUcb, pulls), bound) << pulls;
  }
}

// From pull 1000 on it grows as the bound of Lai and Robbins, which no rule can beat in the long run.
TEST(Bandits, ThompsonSamplingGrowsAsTheLowerBound) {
  double slope = 0;
  for (int k = 0; k < 3; ++k) {
    const double p = kArms[k], best = kArms[3];
    const double divergence = p * std::log(p / best) + (1 - p) * std::log((1 - p) / (1 - best));
    slope += (best - p) / divergence;
  }
  const double more = meanRegret(BanditRule::kThompson, 20000) - meanRegret(BanditRule::kThompson, 1000);
  EXPECT_NEAR(more, slope * std::log(20.), 0.4 * slope * std::log(20.));
  EXPECT_LT(meanRegret(BanditRule::kThompson, 10000), meanRegret(BanditRule::kUcb, 10000) / 2);
}

TEST(Bandits, EpsilonGreedyLosesTheSameInEachPull) {
  const double more =
      meanRegret(BanditRule::kEpsilonGreedy, 20000, 0.2) - meanRegret(BanditRule::kEpsilonGreedy, 10000, 0.2);
  EXPECT_NEAR(more, 10000 * 0.2 * (kArms.maxCoeff() - kArms.mean()), 20);
}

// How often a draw of Beta(a, b) exceeds one of Beta(c, d), for whole numbers a sum in closed form.
double probabilityOfMore(int a, int b, int c, int d) {
  const auto logBeta = [](double x, double y) {
    return std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y);
  };
  double sum = 0;
  for (int i = 0; i < a; ++i)
    sum += std::exp(logBeta(c + i, b + d) - logBeta(1 + i, b) - logBeta(c, d)) / (b + i);
  return sum;
}

TEST(Bandits, ThompsonSamplingChoosesAsOftenAsAnArmMayBeTheBest) {
  Rng rng(3);
  for (const auto& [paid0, pulls0, paid1, pulls1] : {std::array{0, 0, 0, 0}, {3, 5, 1, 2}, {2, 9, 30, 100}}) {
    const ArmRecord record{Eigen::Vector2i(pulls0, pulls1), Eigen::Vector2d(paid0, paid1)};
    int first = 0;
    constexpr int kTimes = 20000;
    for (int k = 0; k < kTimes; ++k) first += nextArm(record, BanditRule::kThompson, rng) == 0;
    const double p = probabilityOfMore(1 + paid0, 1 + pulls0 - paid0, 1 + paid1, 1 + pulls1 - paid1);
    EXPECT_NEAR(first, kTimes * p, 4 * std::sqrt(kTimes * p * (1 - p))) << pulls0;
  }
}

TEST(Bandits, RefuseWhatCannotBe) {
  Rng rng(1);
  EXPECT_REX_ERROR(nextArm({}, BanditRule::kUcb, rng), "bandit: arms: found 0");
  EXPECT_REX_ERROR(nextArm({Eigen::Vector2i(1, 1), VectorXd::Ones(1)}, BanditRule::kUcb, rng),
                   "bandit: what each arm paid: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR(nextArm({Eigen::Vector2i(1, 1), Eigen::Vector2d(1, 2)}, BanditRule::kUcb, rng),
                   "bandit: what arm 1 paid: found 2 in 1 pulls, wanted from 0 to 1 for each pull");
  EXPECT_REX_ERROR(playBandit(kArms, 5, BanditRule::kUcb, rng, 2),
                   "bandit: epsilon: found 2, wanted a number");
  EXPECT_REX_ERROR(playBandit(Eigen::Vector2d(0, 1.5), 5, BanditRule::kUcb, rng),
                   "bandit: probability: found 1.5, wanted a number from 0 to 1");
  EXPECT_REX_ERROR(playBandit(kArms, 0, BanditRule::kUcb, rng), "bandit: pulls: found 0");
}

}  // namespace rex::bandits_test
