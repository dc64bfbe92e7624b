#include "estimation/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/consistency.h"
#include "support/expect_error.h"

namespace rex::resampling_test {

constexpr Resampling kAll[] = {Resampling::kMultinomial, Resampling::kResidual, Resampling::kStratified,
                               Resampling::kSystematic};

Eigen::VectorXd childrenOf(const std::vector<int>& parents, Eigen::Index size) {
  Eigen::VectorXd children = Eigen::VectorXd::Zero(size);
  for (const int parent : parents) ++children[parent];
  return children;
}

TEST(Resampling, DrawsAscendingParentsOfPositiveWeight) {
  Rng rng(1);
  for (int round = 0; round < 2000; ++round) {
    Eigen::VectorXd weights = rng.uniformVector(1 + rng.index(20), 0, 1);
    for (double& weight : weights)
      if (rng.uniform() < .3) weight = 0;
    weights[rng.index(static_cast<int>(weights.size()))] = 1e-3;
    const int count = rng.index(30);
    for (const Resampling how : kAll) {
      const std::vector<int> parents = resampled(weights, count, how, rng);
      ASSERT_EQ(parents.size(), static_cast<std::size_t>(count));
      EXPECT_TRUE(std::is_sorted(parents.begin(), parents.end()));
      for (const int parent : parents) EXPECT_GT(weights[parent], 0);
    }
  }
}

// Chi-square over many draws: no method prefers a particle. The statistic of one draw after the other is
// chi-square only for multinomial draws; the others vary less, so that their means are compared.
TEST(Resampling, IsUnbiased) {
  Eigen::VectorXd weights(6);
  weights << .02, .3, .11, .07, .25, .25;
  const int count = 7, rounds = 40000;
  for (const Resampling how : kAll) {
    Rng rng(2);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(6), square = mean;
    for (int round = 0; round < rounds; ++round) {
      const Eigen::VectorXd children = childrenOf(resampled(weights, count, how, rng), 6);
      mean += children / rounds;
      square += children.cwiseAbs2() / rounds;
    }
    double statistic = 0;
    for (int i = 0; i < 6; ++i) {
      const double variance = square[i] - mean[i] * mean[i];
      statistic += std::pow(mean[i] - count * weights[i], 2) / (variance / rounds) / 6;
    }
    EXPECT_LT(6 * statistic, chiSquareQuantile(1 - 1e-5, 6)) << static_cast<int>(how);
  }
}

TEST(Resampling, ResidualKeepsWholeParts) {
  Rng rng(3);
  for (int round = 0; round < 500; ++round) {
    const Eigen::VectorXd weights = rng.uniformVector(10, 0, 1);
    const int count = 1 + rng.index(50);
    const Eigen::VectorXd share = count * weights / weights.sum();
    const Eigen::VectorXd residual = childrenOf(resampled(weights, count, Resampling::kResidual, rng), 10);
    const Eigen::VectorXd systematic =
        childrenOf(resampled(weights, count, Resampling::kSystematic, rng), 10);
    for (int i = 0; i < 10; ++i) {
      EXPECT_GE(residual[i], std::floor(share[i] * (1 - 1e-12)));
      EXPECT_LE(std::abs(systematic[i] - share[i]), 1 + 1e-9);
    }
  }
  // Equal weights change nothing, whatever rounding makes of their shares.
  for (int count = 1; count < 2000; ++count) {
    const Eigen::VectorXd equal = Eigen::VectorXd::Constant(count, 1. / count);
    EXPECT_EQ(childrenOf(resampled(equal, count, Resampling::kResidual, rng), count).maxCoeff(), 1) << count;
  }
  const Eigen::VectorXd thirds = Eigen::VectorXd::Constant(3, 1. / 3);
  for (int count = 3; count < 300; count += 3)
    EXPECT_EQ(childrenOf(resampled(thirds, count, Resampling::kResidual, rng), 3).maxCoeff(), count / 3);
}

// Sums of these would overflow, or vanish.
TEST(Resampling, TakesWeightsOfAnySize) {
  Rng rng(5);
  for (const double size : {1e308, 1e-300, 5e-324})
    for (const Resampling how : kAll) {
      const Eigen::VectorXd children = childrenOf(resampled(Eigen::Vector2d(size, size), 400, how, rng), 2);
      EXPECT_NEAR(children[0], 200, 60) << size;
      EXPECT_DOUBLE_EQ(effectiveSampleSize(Eigen::Vector2d(size, size)), 2);
    }
}

TEST(Resampling, CountsEffectiveParticles) {
  EXPECT_DOUBLE_EQ(effectiveSampleSize(Eigen::VectorXd::Constant(40, .3)), 40);
  EXPECT_DOUBLE_EQ(effectiveSampleSize(Eigen::Vector3d(0, 2, 0)), 1);
  EXPECT_NEAR(effectiveSampleSize(Eigen::Vector2d(1, 2)), 9. / 5, 1e-15);
  EXPECT_DOUBLE_EQ(effectiveSampleSize(Eigen::VectorXd::Constant(4, 1e-200)), 4) << "squares of these vanish";
}

// Equation 7 approximates the chi-square quantile of equation 6.
TEST(Resampling, AdaptiveSizeIsTheQuantile) {
  for (const int cells : {2, 5, 20, 100, 1000}) {
    const double exact = chiSquareQuantile(.99, cells - 1) / (2 * .05);
    EXPECT_NEAR(adaptiveSampleSize(cells, .05, 2.3263), exact, .02 * exact + 1);
  }
  EXPECT_EQ(adaptiveSampleSize(1, .05), 1);
  EXPECT_EQ(adaptiveSampleSize(2, 1e10), 1);
  EXPECT_EQ(adaptiveSampleSize(5000, 1e-7), std::numeric_limits<int>::max()) << "more than can be counted";
}

TEST(Resampling, SaysWhatIsWrong) {
  Rng rng(4);
  EXPECT_REX_ERROR(resampled(Eigen::Vector2d(1, -1), 2, Resampling::kResidual, rng),
                   "weights of particles: number 1: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(resampled(Eigen::Vector2d(std::nan(""), 1), 2, Resampling::kResidual, rng),
                   "weights of particles: number 0: found nan");
  EXPECT_REX_ERROR(resampled(Eigen::Vector2d(0, 0), 2, Resampling::kResidual, rng),
                   "weights: found only zeros, wanted a positive one");
  EXPECT_REX_ERROR(resampled(Eigen::Vector2d(1, 0), -1, Resampling::kResidual, rng),
                   "particles to draw: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(adaptiveSampleSize(0, .1), "occupied cells: found 0, wanted at least 1");
  EXPECT_REX_ERROR(adaptiveSampleSize(2, 0), "error: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(adaptiveSampleSize(2, .1, -1), "quantile: found -1, wanted a positive, finite number");
}

}  // namespace rex::resampling_test
