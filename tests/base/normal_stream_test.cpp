#include "base/normal_stream.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/normal_kernel_internal.h"
#include "base/rng.h"

namespace rex::normal_stream_test {

std::vector<double> drawn(std::uint64_t seed, std::size_t count) {
  Rng rng(seed);
  std::vector<double> numbers(count);
  NormalStream(rng).fill(numbers);
  return numbers;
}

// One stream as its authors give it, with the functions of the library.
class Stream {
 public:
  std::uint64_t word[4];

  double uniform() { return static_cast<double>(next() >> 12) * 0x1p-52; }

 private:
  std::uint64_t next() {
    const std::uint64_t result = std::rotl(word[0] + word[3], 23) + word[0], t = word[1] << 17;
    word[2] ^= word[0];
    word[3] ^= word[1];
    word[1] ^= word[2];
    word[0] ^= word[3];
    word[2] ^= t;
    word[3] = std::rotl(word[3], 45);
    return result;
  }
};

TEST(NormalStream, IsBoxAndMullersMethodOnFourStreams) {
  Rng rng(11);
  std::array<Stream, 4> streams{};
  for (int i = 0; i < 4; ++i)
    for (Stream& stream : streams) stream.word[i] = rng.next();
  const std::vector<double> numbers = drawn(11, 8000);
  for (std::size_t block = 0; block < 1000; ++block)
    for (std::size_t k = 0; k < 4; ++k) {
      const double radius = std::sqrt(-2 * std::log(1 - streams[k].uniform()));
      const double angle = 2 * std::numbers::pi * (streams[k].uniform() - 0.5);
      ASSERT_NEAR(numbers[8 * block + k], radius * std::cos(angle), 1e-14);
      ASSERT_NEAR(numbers[8 * block + 4 + k], radius * std::sin(angle), 1e-14);
    }
}

// The distance of Kolmogorov and Smirnov is above 2.3 / sqrt(n) once in 20 000 times.
TEST(NormalStream, IsStandardNormal) {
  std::vector<double> numbers = drawn(12, 200003);
  const double n = static_cast<double>(numbers.size());
  std::sort(numbers.begin(), numbers.end());
  double distance = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double share = 0.5 * std::erfc(-numbers[i] / std::numbers::sqrt2);
    distance = std::max({distance, std::abs(share - static_cast<double>(i) / n),
                         std::abs(share - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(distance, 2.3 / std::sqrt(n));
  EXPECT_LT(numbers.front(), -4);
  EXPECT_GT(numbers.back(), 4);
}

// Neither numbers near each other in the sequence nor their squares are correlated: five deviations.
TEST(NormalStream, IsIndependent) {
  const std::vector<double> numbers = drawn(13, 400000);
  for (std::size_t lag = 1; lag <= 16; ++lag) {
    double products = 0, squares = 0;
    for (std::size_t i = lag; i < numbers.size(); ++i) {
      const double a = numbers[i], b = numbers[i - lag];
      products += a * b;
      squares += (a * a - 1) * (b * b - 1);
    }
    const double bound = 5 * std::sqrt(static_cast<double>(numbers.size()));
    EXPECT_LT(std::abs(products), bound) << lag;
    EXPECT_LT(std::abs(squares), 2 * bound) << lag;
  }
}

TEST(NormalStream, IsTheSameForTheSameSeedAndGoesOn) {
  EXPECT_EQ(drawn(14, 21), drawn(14, 21));
  EXPECT_NE(drawn(14, 21), drawn(15, 21));
  Rng rng(14);
  NormalStream stream(rng);
  std::vector<double> once(24), twice(24);
  stream.fill(once);
  stream.fill(twice);
  EXPECT_NE(once, twice);
  std::vector<double> whole = drawn(14, 48);
  EXPECT_TRUE(std::equal(once.begin(), once.end(), whole.begin()));
  EXPECT_TRUE(std::equal(twice.begin(), twice.end(), whole.begin() + 24));
}

TEST(NormalStream, FillsAnyLength) {
  const std::vector<double> whole = drawn(16, 16);
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 15u}) {
    const std::vector<double> part = drawn(16, count);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin())) << count;
  }
}

class NormalsInLanes : public testing::TestWithParam<int> {};

TEST_P(NormalsInLanes, HaveTheBitsOfOne) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto computed = [](int lanes) {
    Rng rng(17);
    std::array<std::uint64_t, 16> words{};
    for (std::uint64_t& word : words) word = rng.next();
    std::vector<double> numbers(8000);
    kernelFor<internal::NormalKernel>(lanes).fill(words.data(), numbers.data(), 1000);
    return std::pair(numbers, words);
  };
  EXPECT_EQ(computed(1), computed(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, NormalsInLanes, testing::Values(2, 4));

}  // namespace rex::normal_stream_test
