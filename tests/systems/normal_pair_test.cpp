#include "systems/normal_pair.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"

namespace rex::normal_pair_test {

TEST(NormalPair, IsWhatBoxAndMullerSay) {
  Rng rng(2);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t one = rng.next(), other = rng.next();
    const double u = 1 - static_cast<double>(one >> 12) * 0x1p-52,
                 v = static_cast<double>(other >> 12) * 0x1p-52;
    const double radius = std::sqrt(-2 * std::log(u)), angle = 2 * std::numbers::pi * v;
    const auto pair = internal::normalPair<double>(one, other);
    ASSERT_NEAR(pair.first, radius * std::cos(angle), 1e-14);
    ASSERT_NEAR(pair.second, radius * std::sin(angle), 1e-14);
  }
  EXPECT_EQ(internal::normalPair<double>(0, 0).first, 0);  // the smallest radius, and the largest
  EXPECT_NEAR(internal::normalPair<double>(~0ull, 0).first, std::sqrt(2 * 52 * std::log(2)), 1e-13);
}

TEST(NormalPair, HasNormalMoments) {
  constexpr int kDraws = 100000;
  Rng rng(3);
  double sum = 0, squares = 0, products = 0, fourths = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto [a, b] = internal::normalPair(rng);
    sum += a + b;
    squares += a * a + b * b;
    products += a * b;
    fourths += a * a * a * a;
  }
  const double root = std::sqrt(kDraws);
  EXPECT_NEAR(sum / kDraws, 0, 6 / root);
  EXPECT_NEAR(squares / kDraws, 2, 8 / root);
  EXPECT_NEAR(products / kDraws, 0, 4 / root);
  EXPECT_NEAR(fourths / kDraws, 3, 40 / root);
}

// That of one lane; those of more are compared through the rollouts.
TEST(NormalPair, GeneratorOfALaneIsRng) {
  Rng rng(4);
  internal::LaneRng<double> lane{{rng.state()[0], rng.state()[1], rng.state()[2], rng.state()[3]}};
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(lane.next(), rng.next());
}

}  // namespace rex::normal_pair_test
