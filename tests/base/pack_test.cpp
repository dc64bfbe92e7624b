#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/pack_kernel.h"
#include "base/rng.h"

namespace rex::pack_test {

// Pairs of numbers of all sizes, and of all that is special with one another.
struct Numbers {
  std::vector<double> x, y;
  Numbers() {
    using Limits = std::numeric_limits<double>;
    const double special[] = {
        0.,     -0.,           1.,    -2.5, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
        1e-310, Limits::max(), 1. / 3};
    for (const double a : special)
      for (const double b : special) add(a, b);
    Rng rng(51);
    for (int i = 0; i < 1000; ++i)
      add(std::ldexp(rng.normal(), rng.index(2000) - 1000), std::ldexp(rng.normal(), rng.index(2000) - 1000));
  }
  void add(double a, double b) {
    x.push_back(a);
    y.push_back(b);
  }
  std::vector<double> results(int lanes) const {
    std::vector<double> results(PackKernel::kOperations * x.size());
    const int count = static_cast<int>(x.size());
    kernelFor<PackKernel>(lanes).operations(x.data(), y.data(), count, results.data());
    return results;
  }
};

class PackOfLanes : public testing::TestWithParam<int> {};

TEST_P(PackOfLanes, HasTheBitsOfDoubles) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const Numbers numbers;
  const std::vector<double> alone = numbers.results(1), packed = numbers.results(GetParam());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    // What a NaN is made of is left open by the standard.
    if (std::isnan(alone[i]) && std::isnan(packed[i])) continue;
    ASSERT_EQ(std::memcmp(&alone[i], &packed[i], sizeof(double)), 0)
        << "operation " << i % PackKernel::kOperations << " of " << numbers.x[i / PackKernel::kOperations]
        << " and " << numbers.y[i / PackKernel::kOperations] << ": " << alone[i] << " and " << packed[i];
  }
}

TEST_P(PackOfLanes, SeesWhetherAnyOrAllLanesHold) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  constexpr int kCount = 64;  // in fours, in which the lanes take all 16 cases in turn
  double x[kCount], y[kCount];
  for (int i = 0; i < kCount; ++i) {
    x[i] = (i / 4) >> (i % 4) & 1 ? 0 : 2;
    y[i] = 1;
  }
  bool isAny[kCount], isAll[kCount];
  kernelFor<PackKernel>(GetParam()).compare(x, y, kCount, isAny, isAll);
  for (int begin = 0; begin < kCount; begin += GetParam()) {
    const auto isLess = [](double number) { return number < 1; };
    EXPECT_EQ(isAny[begin / GetParam()], std::any_of(x + begin, x + begin + GetParam(), isLess)) << begin;
    EXPECT_EQ(isAll[begin / GetParam()], std::all_of(x + begin, x + begin + GetParam(), isLess)) << begin;
  }
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, PackOfLanes, testing::Values(2, 4));

TEST(Pack, AddsAndSelectsAsWritten) {
  const double x[4] = {1, 2, 3, 4}, y[4] = {4, 3, 2, 1};
  double results[4 * PackKernel::kOperations];
  kernelFor<PackKernel>(1).operations(x, y, 4, results);
  EXPECT_EQ(results[0], 5);
  EXPECT_EQ(results[PackKernel::kOperations + 14], 2);
  EXPECT_EQ(results[2 * PackKernel::kOperations + 14], 2);
}

}  // namespace rex::pack_test
