#include <cmath>
#include <limits>
#include <tuple>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "estimation/weights_kernel_internal.h"

namespace rex::weights_kernel_test {

class WeightsInLanes : public testing::TestWithParam<int> {};

TEST_P(WeightsInLanes, BecomeExponentialsToTheBit) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  Rng rng(12);
  const Eigen::VectorXd logWeights = 3 * rng.normalVector(1027);
  const auto computed = [&](int lanes) {
    Eigen::VectorXd weights(logWeights.size());
    const auto kernel = kernelFor<internal::WeightsKernel>(lanes);
    const double largest = kernel.largest(logWeights.data(), logWeights.size(), -HUGE_VAL);
    EXPECT_EQ(largest, logWeights.maxCoeff());
    const double sum = kernel.exponentials(logWeights.data(), largest, logWeights.size(), weights.data());
    EXPECT_NEAR(sum, weights.sum(), 1e-12 * sum);
    EXPECT_LT((weights.array().log() - (logWeights.array() - largest)).abs().maxCoeff(), 1e-13);
    return std::tuple(weights, sum);
  };
  EXPECT_EQ(computed(1), computed(GetParam()));
}

TEST_P(WeightsInLanes, AddUpAndDivideToTheBit) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto one = kernelFor<internal::WeightsKernel>(1),
             many = kernelFor<internal::WeightsKernel>(GetParam());
  Rng rng(13);
  for (const int count : {1, 2, 3, 4, 5, 6, 7, 8, 11, 1000}) {
    const Eigen::VectorXd weights = rng.uniformVector(count, 0, 1);
    Eigen::VectorXd quotients(count), again(count);
    const auto sums = one.divide(weights.data(), 0.3, count, quotients.data());
    EXPECT_EQ(quotients, weights / 0.3);
    EXPECT_NEAR(sums.plain, quotients.sum(), 1e-13 * count);
    EXPECT_NEAR(sums.squared, quotients.squaredNorm(), 1e-13 * count);
    const auto sumsAgain = many.divide(weights.data(), 0.3, count, again.data());
    EXPECT_EQ(std::tuple(sums.plain, sums.squared), std::tuple(sumsAgain.plain, sumsAgain.squared));
    EXPECT_EQ(quotients, again);
  }
}

// A number that is not in range is seen wherever it is, and the least is in range.
TEST_P(WeightsInLanes, SeeWhatIsOutOfRange) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto kernel = kernelFor<internal::WeightsKernel>(GetParam());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 7; ++i) {
    Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(7, 0, 6);
    EXPECT_EQ(kernel.largest(numbers.data(), 7, 0), 6);
    for (const double wrong : {nan, HUGE_VAL, -1e-300}) {
      numbers[i] = wrong;
      EXPECT_TRUE(std::isnan(kernel.largest(numbers.data(), 7, 0))) << i << ' ' << wrong;
    }
    numbers[i] = -HUGE_VAL;
    EXPECT_EQ(kernel.largest(numbers.data(), 7, -HUGE_VAL), i == 6 ? 5 : 6);
  }
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, WeightsInLanes, testing::Values(2, 4));

}  // namespace rex::weights_kernel_test
