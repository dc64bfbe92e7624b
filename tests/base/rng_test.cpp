#include "base/rng.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::rng_test {

// The reference sequence of xoshiro256** for the state (1, 2, 3, 4), by hand from its definition:
// rotl(2*5, 7)*9 = 11520, then the state moves on.
TEST(Rng, FollowsThePublishedGenerator) {
  Rng rng = Rng::fromState({1, 2, 3, 4});
  EXPECT_EQ(rng.next(), 11520u);
  EXPECT_EQ(rng.next(), 0u);
  EXPECT_EQ(rng.next(), 1509978240u);
  EXPECT_EQ(rng.next(), 1215971899390074240u);
}

TEST(Rng, SameSeedSameSequence) {
  Rng a(7), b(7), c(8);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.next();
    EXPECT_EQ(bits, b.next());
    differs = differs || bits != c.next();
  }
  EXPECT_TRUE(differs);
}

TEST(Rng, UniformHasTheRightMomentsAndRange) {
  Rng rng(1);
  const int n = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.uniform(-1, 3);
    ASSERT_GE(x, -1);
    ASSERT_LT(x, 3);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 1, 0.02);                 // five standard errors: 5 * (4/sqrt(12))/sqrt(n)
  EXPECT_NEAR(squares / n, 1 + 16. / 12, 0.04);  // E x^2 = mean^2 + variance
}

TEST(Rng, NormalHasTheRightMoments) {
  Rng rng(2);
  const int n = 200000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal();
    m1 += x, m2 += x * x, m3 += x * x * x, m4 += x * x * x * x;
  }
  EXPECT_NEAR(m1 / n, 0, 0.012);
  EXPECT_NEAR(m2 / n, 1, 0.016);
  EXPECT_NEAR(m3 / n, 0, 0.045);
  EXPECT_NEAR(m4 / n, 3, 0.12);
}

TEST(Rng, IndexCoversItsRangeEvenly) {
  Rng rng(3);
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts.at(static_cast<std::size_t>(rng.index(6)));
  for (int count : counts) EXPECT_NEAR(count, 10000, 500);
}

TEST(Rng, SplitsIntoIndependentStreams) {
  const Rng rng(4);
  std::set<std::uint64_t> firsts;
  for (std::uint64_t stream = 0; stream < 1000; ++stream) firsts.insert(rng.split(stream).next());
  EXPECT_EQ(firsts.size(), 1000u);
  EXPECT_EQ(rng.split(5).next(), rng.split(5).next());
}

TEST(Rng, ResumesFromItsState) {
  Rng rng(5);
  rng.next();
  Rng copy = Rng::fromState(rng.state());
  EXPECT_EQ(copy.normalVector(10), rng.normalVector(10));
  EXPECT_EQ(copy.uniformVector(10, 0, 1), rng.uniformVector(10, 0, 1));
}

TEST(Rng, RefusesImpossibleRanges) {
  Rng rng(6);
  EXPECT_REX_ERROR(rng.uniform(1, 0), "uniform random number: found the range [1, 0), wanted finite bounds");
  EXPECT_REX_ERROR(rng.uniform(0, std::nan("")), "found the range [0, nan)");
  EXPECT_REX_ERROR(rng.normalVector(-1), "random vector: found size -1, wanted 0 or more");
  EXPECT_REX_ERROR(rng.uniformVector(-2, 0, 1), "random vector: found size -2, wanted 0 or more");
  EXPECT_EQ(rng.normalVector(0).size(), 0);
  EXPECT_REX_ERROR(rng.index(0), "random index: found count 0, wanted count > 0");
  EXPECT_REX_ERROR(Rng::fromState({0, 0, 0, 0}), "random generator state: found all zeros");
}

}  // namespace rex::rng_test
