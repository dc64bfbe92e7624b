#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "base/sin_cos_kernel.h"

namespace rex::sin_cos_test {

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
  using Limits = std::numeric_limits<double>;
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

}  // namespace rex::sin_cos_test
