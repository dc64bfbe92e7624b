#include "grading/sketch.h"

#include <cmath>
#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/layout.h"
#include "remote/wire.h"
#include "support/expect_error.h"

namespace rex::grading::sketch_test {

using Eigen::Matrix2d;
using Eigen::Vector3d;

template <class T>
std::vector<std::byte> bytesOf(const T& value) {
  remote::Writer writer;
  remote::Wire<T>::put(writer, value);
  return {writer.bytes().begin(), writer.bytes().end()};
}

template <class T>
Sketch sketchOf(const T& value) {
  return grading::sketchOf(bytesOf(value), remote::Layout<T>::text());
}

template <class T>
bool agree(const T& a, const T& b) {
  return grading::agree(sketchOf(a), sketchOf(b));
}

TEST(Sketch, IsTheSameWithinTheRoundingOfHonestCode) {
  const Vector3d right(0.3, -2000, 7e-4);
  EXPECT_TRUE(agree(right, right));
  EXPECT_TRUE(agree(right, Vector3d(right * (1 + 1e-9))));
  EXPECT_TRUE(agree(Vector3d(1e-13, 0, 0), Vector3d(0, -2e-14, 0))) << "rounded zeros";
  EXPECT_TRUE(agree(0.0, -0.0));
  EXPECT_FALSE(agree(right, Vector3d(right * (1 + 1e-3))));
}

TEST(Sketch, DiffersWithEachUsualMistake) {
  const Vector3d right(0.3, -1.2, 0.7);
  EXPECT_FALSE(agree(right, Vector3d(-right)));
  EXPECT_FALSE(agree(right, Vector3d(0.3, 1.2, 0.7)));
  EXPECT_FALSE(agree(right, Vector3d(-1.2, 0.3, 0.7)));
  EXPECT_FALSE(agree(right, Vector3d(2 * right)));
  const Matrix2d J{{1, 2}, {3, 4}};
  EXPECT_FALSE(agree(J, Matrix2d(J.transpose())));
  EXPECT_FALSE(agree(std::vector{1, 2, 3}, std::vector{3, 2, 1}));
  EXPECT_FALSE(agree(true, false));
  EXPECT_FALSE(agree(-1, 1));
}

TEST(Sketch, DiffersInSizesTextsAndNumbersThatAreNotFinite) {
  EXPECT_FALSE(agree(std::vector<double>{}, std::vector<double>{0}));
  EXPECT_FALSE(
      agree(Eigen::MatrixXd(Eigen::MatrixXd::Zero(2, 3)), Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 2))));
  EXPECT_FALSE(agree(std::string("peg"), std::string("pig")));
  EXPECT_FALSE(agree(std::optional<int>{}, std::optional<int>{0}));
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::nan("");
  EXPECT_TRUE(agree(kNaN, kNaN));
  EXPECT_FALSE(agree(kNaN, 0.0));
  EXPECT_FALSE(agree(kInfinity, kNaN));
  EXPECT_TRUE(std::isfinite(sketchOf(Vector3d(1e300, -1e300, 1e308)).size));
}

TEST(Sketch, KnowsWhetherAllNumbersAreWhole) {
  EXPECT_TRUE(sketchOf(Vector3d(0, -2, 3e6)).isWhole);
  EXPECT_TRUE(sketchOf(std::int8_t{-3}).isWhole);
  EXPECT_EQ(sketchOf(std::int8_t{-3}).size, 3);
  EXPECT_FALSE(sketchOf(Vector3d(0, 0.5, 1)).isWhole);
}

TEST(Sketch, RefusesBytesOfAnotherLayout) {
  EXPECT_REX_ERROR(static_cast<void>(grading::sketchOf(bytesOf(0.1), "M3,1,d")),
                   "an answer does not match its layout");
}

// Calls of f(double), which returns a number, as one check makes them.
class SketcherTest : public ::testing::Test {
 protected:
  void hear(double argument, std::optional<double> answer) {
    const std::vector<std::byte> asked = bytesOf(argument), answered = bytesOf(answer.value_or(0));
    sketcher_.hear(0, "f", asked, answer ? std::optional<CallSketcher::Bytes>(answered) : std::nullopt);
  }
  std::vector<SketchedCall> take() { return std::move(sketcher_).take(); }

  CallLayouts layouts_{{"d", "d"}};
  CallSketcher sketcher_{layouts_};
};

TEST_F(SketcherTest, NamesCallsByTheirArguments) {
  hear(1, 10);
  hear(1 + 1e-14, 10);
  hear(1.01, 10);
  sketcher_.nextCase();
  hear(1, 10);
  const std::vector<SketchedCall> calls = take();
  ASSERT_EQ(calls.size(), 4);
  EXPECT_EQ(calls[0].function, "f");
  EXPECT_NE(calls[0].key, calls[1].key) << "asked again";
  EXPECT_NE(calls[0].key, calls[2].key);
  EXPECT_NE(calls[0].key, calls[3].key) << "another case";
  CallSketcher other(layouts_);
  other.hear(0, "f", bytesOf(1 - 1e-14), {});
  const std::vector<SketchedCall> again = std::move(other).take();
  ASSERT_EQ(again.size(), 1);
  EXPECT_EQ(again[0].key, calls[0].key) << "the same but for rounding";
}

TEST_F(SketcherTest, KeepsThatAFunctionThrew) {
  hear(1, {});
  const std::vector<SketchedCall> calls = take();
  ASSERT_EQ(calls.size(), 1);
  EXPECT_TRUE(calls[0].answer.threw);
  EXPECT_FALSE(agree(calls[0].answer, sketchOf(0.0)));
  EXPECT_TRUE(agree(calls[0].answer, calls[0].answer));
}

TEST_F(SketcherTest, KeepsTheFirstCallsOfACase) {
  for (int k = 0; k < 200; ++k) hear(k, k);
  sketcher_.nextCase();
  hear(1, 1);
  EXPECT_EQ(take().size(), 101);
}

TEST_F(SketcherTest, LeavesOutWhatNobodyCanRead) {
  sketcher_.hear(0, "f", bytesOf(1.0), bytesOf(std::uint8_t{1}));
  sketcher_.hear(0, "f", bytesOf(std::uint8_t{1}), bytesOf(1.0));
  sketcher_.hear(7, "unknown", bytesOf(1.0), bytesOf(1.0));
  EXPECT_TRUE(take().empty());
}

}  // namespace rex::grading::sketch_test
