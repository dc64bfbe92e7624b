#include "remote/layout.h"

#include <gtest/gtest.h>

#include "remote/call.h"
#include "support/expect_error.h"

namespace rex::remote::layout_test {

enum class Colour : std::uint8_t { red };

struct Inner {
  double x = 0;
  Eigen::Vector3d p;
};

struct Outer {
  std::vector<Inner> all;
  std::optional<Colour> colour;
  std::pair<int, bool> pair;
  std::array<float, 2> two{};
};

TEST(Layout, TellsHowBytesLie) {
  EXPECT_EQ(Layout<double>::text(), "d");
  EXPECT_EQ(Layout<std::string>::text(), "s");
  EXPECT_EQ(Layout<SplitRng>::text(), "r");
  EXPECT_EQ(Layout<std::uint64_t>::text(), "u8");
  EXPECT_EQ(Layout<Eigen::MatrixXd>::text(), "M-1,-1,d");
  EXPECT_EQ(Layout<Eigen::Matrix2Xi>::text(), "M2,-1,i4");
  EXPECT_EQ(Layout<Outer>::text(), "([(dM3,1,d)]?u1(i4b)(ff))");
}

TEST(CallLayout, HasTheResultFirst) {
  using Function = Eigen::VectorXd(const Eigen::VectorXd&, int, const std::function<double(double)>&);
  EXPECT_EQ(CallLayout<Function>::texts(), (std::vector<std::string>{"M-1,1,d", "M-1,1,d", "i4", "b"}));
  EXPECT_EQ(CallLayout<void()>::texts(), std::vector<std::string>{""});
}

// What answers may be, between the bytes and the first thing that computes with them.
TEST(AnswerLimits, AreAskedBeforeAnAnswerIsUsed) {
  Writer writer;
  const auto answer = [&](double a, double b) {
    writer = {};
    Wire<Inner>::put(writer, {.x = a, .p = Eigen::Vector3d(0, b, 0)});
    return writer.bytes();
  };
  Caller::Bytes bytes;
  Caller standIn([&](std::uint32_t) { return bytes; });
  const Call<Inner(int)> call(standIn, 0, "inner");
  const auto refusal = [&](double a, double b, bool infinite = false) -> std::string {
    bytes = answer(a, b);
    try {
      infinite ? call.orInfinite()(1) : call(1);
      return "";
    } catch (const AnswerRefused& refused) {
      EXPECT_EQ(refused.function(), "inner");
      return refused.what();
    }
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(1, -1e100), "");
  EXPECT_EQ(refusal(std::nan(""), 0), "number 1 is nan, wanted finite numbers");
  EXPECT_EQ(refusal(0, -std::nan("")), "number 3 is nan, wanted finite numbers");
  EXPECT_EQ(refusal(0, -kInfinity), "number 3 is -inf, wanted finite numbers");
  EXPECT_EQ(refusal(0, -1e101), "number 3 is -1e+101, wanted at most 1e+100");
  EXPECT_EQ(refusal(0, -kInfinity, true), "");
  EXPECT_EQ(refusal(0, std::nan(""), true), "number 3 is nan, wanted finite numbers");
}

TEST(AnswerLimits, HoldForSinglePrecision) {
  Writer writer;
  Wire<std::pair<float, Eigen::Vector2f>>::put(writer, {1.f, {0, std::numeric_limits<float>::infinity()}});
  Caller standIn([&](std::uint32_t) { return writer.bytes(); });
  const Call<std::pair<float, Eigen::Vector2f>(int)> call(standIn, 0, "pair");
  EXPECT_THROW(call(1), AnswerRefused);
  EXPECT_EQ(call.orInfinite()(1).first, 1.f);
}

}  // namespace rex::remote::layout_test
