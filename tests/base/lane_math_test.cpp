#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/exp_log_kernel.h"
#include "base/rng.h"
#include "base/sin_cos_kernel.h"

namespace rex::lane_math_test {

using Limits = std::numeric_limits<double>;
using Function = void (*)(const double* numbers, int count, double* out);

std::vector<double> results(Function function, const std::vector<double>& numbers) {
  std::vector<double> out(numbers.size());
  function(numbers.data(), static_cast<int>(numbers.size()), out.data());
  return out;
}

std::vector<double> manyExponents() {
  Rng rng(43);
  std::vector<double> numbers{0, -0., 1, -1, 709, -708, 1e-300, -1e-17};
  for (int i = 0; i < 20000; ++i)
    for (const double range : {1e-9, 1., 30., 708.}) numbers.push_back(rng.uniform(-range, range));
  return numbers;
}

std::vector<double> manyPositives() {
  std::vector<double> numbers{1,   0x1p-52, Limits::min(), Limits::max(), std::sqrt(0.5), std::sqrt(2.),
                              0.5, 2};
  for (const double x : manyExponents()) numbers.push_back(std::exp(x));
  Rng rng(44);
  for (int i = 0; i < 20000; ++i) numbers.push_back(1 + rng.uniform(-1e-3, 1e-3));
  return numbers;
}

TEST(ExpLog, ExponentialAgreesWithTheLibrary) {
  const std::vector<double> numbers = manyExponents();
  ASSERT_EQ(numbers.size() % 4, 0u);
  const std::vector<double> got = results(kernelFor<ExpLogKernel>(1).exponentials, numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    ASSERT_NEAR(got[i] / std::exp(numbers[i]), 1, 3e-16) << numbers[i];
}

TEST(ExpLog, LogarithmAgreesWithTheLibrary) {
  const std::vector<double> numbers = manyPositives();
  ASSERT_EQ(numbers.size() % 4, 0u);
  const std::vector<double> got = results(kernelFor<ExpLogKernel>(1).logarithms, numbers);
  EXPECT_EQ(got[0], 0);
  for (std::size_t i = 1; i < numbers.size(); ++i)
    ASSERT_NEAR(got[i], std::log(numbers[i]), 4e-16 * std::abs(std::log(numbers[i]))) << numbers[i];
}

TEST(ExpLog, ExponentialOfVeryNegativeNumbersIsZero) {
  for (const double x :
       results(kernelFor<ExpLogKernel>(1).exponentials, {-708.01, -1e300, -Limits::infinity(), -1e9}))
    EXPECT_EQ(x, 0);
}

TEST(ExpLog, ExponentialKeepsWhatIsNoNumber) {
  for (const double x :
       results(kernelFor<ExpLogKernel>(1).exponentials, std::vector<double>(4, Limits::quiet_NaN())))
    EXPECT_TRUE(std::isnan(x));
}

class ExpLogInLanes : public testing::TestWithParam<int> {};

TEST_P(ExpLogInLanes, HasTheBitsOfOne) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto same = [](Function alone, Function packed, const std::vector<double>& numbers) {
    const std::vector<double> a = results(alone, numbers), b = results(packed, numbers);
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  };
  const auto alone = kernelFor<ExpLogKernel>(1), packed = kernelFor<ExpLogKernel>(GetParam());
  std::vector<double> exponents = manyExponents();
  exponents.insert(exponents.end(), {-1e300, -709, -Limits::infinity(), 3});
  EXPECT_TRUE(same(alone.exponentials, packed.exponentials, exponents));
  EXPECT_TRUE(same(alone.logarithms, packed.logarithms, manyPositives()));
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, ExpLogInLanes, testing::Values(2, 4));

struct SinesAndCosines {
  std::vector<double> sines, cosines;
};

SinesAndCosines compute(const std::vector<double>& angles, int lanes) {
  SinesAndCosines result{angles, angles};
  kernelFor<SinCosKernel>(lanes).sinCos(angles.data(), static_cast<int>(angles.size()), result.sines.data(),
                                        result.cosines.data());
  return result;
}

// Of all sizes in turn, so that lanes differ in whether an angle is too large for the polynomials; then what
// lies where the quarters change.
std::vector<double> manyAngles() {
  Rng rng(41);
  std::vector<double> angles;
  for (int i = 0; i < 20000; ++i) {
    for (const double range : {1e-9, 1., 10., 1e3, 1e5, 1e9, 3., 1e22})
      angles.push_back(rng.uniform(-range, range));
  }
  for (int quarter = -8; quarter <= 8; ++quarter) {
    for (const double offset : {-std::numbers::pi / 4, -1e-12, 0., std::numbers::pi / 4})
      angles.push_back(quarter * std::numbers::pi / 2 + offset);
  }
  for (const double edge : {0., -0., 1e-300, 99999.9, -99999.9, 1e5, -1e5, 1e22}) angles.push_back(edge);
  return angles;
}

TEST(SinCos, AgreesWithTheLibrary) {
  const std::vector<double> angles = manyAngles();
  ASSERT_EQ(angles.size() % 4, 0u);
  const SinesAndCosines got = compute(angles, 1);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    ASSERT_NEAR(got.sines[i], std::sin(angles[i]), 3e-16) << angles[i];
    ASSERT_NEAR(got.cosines[i], std::cos(angles[i]), 3e-16) << angles[i];
  }
}

TEST(SinCos, KeepsNoNumbersForNoAngle) {
  const SinesAndCosines got = compute({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 0.}, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(got.sines[i]));
    EXPECT_TRUE(std::isnan(got.cosines[i]));
  }
  EXPECT_EQ(got.cosines[3], 1);
}

class SinCosInLanes : public testing::TestWithParam<int> {};

TEST_P(SinCosInLanes, HasTheBitsOfOne) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const std::vector<double> angles = manyAngles();
  const SinesAndCosines alone = compute(angles, 1), packed = compute(angles, GetParam());
  const std::size_t bytes = angles.size() * sizeof(double);
  EXPECT_EQ(std::memcmp(alone.sines.data(), packed.sines.data(), bytes), 0);
  EXPECT_EQ(std::memcmp(alone.cosines.data(), packed.cosines.data(), bytes), 0);
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, SinCosInLanes, testing::Values(2, 4));

}  // namespace rex::lane_math_test
