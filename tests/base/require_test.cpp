#include "base/require.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::require_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

// The whole message, where EXPECT_REX_ERROR sees a part.
template <typename Call>
std::string messageOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RequirePositive, TakesPositiveFiniteNumbersOnly) {
  EXPECT_NO_THROW(requirePositive("mass", kLeast));
  EXPECT_NO_THROW(requirePositive("mass", kMost));
  const auto of = [](double number) { return messageOf([&] { requirePositive("mass", number); }); };
  EXPECT_EQ(of(0), "mass: found 0, wanted a positive, finite number");
  EXPECT_EQ(of(-1.5), "mass: found -1.5, wanted a positive, finite number");
  EXPECT_EQ(of(kInfinity), "mass: found inf, wanted a positive, finite number");
  EXPECT_EQ(of(-kInfinity), "mass: found -inf, wanted a positive, finite number");
  EXPECT_EQ(of(kNan), "mass: found nan, wanted a positive, finite number");
}

TEST(RequirePositive, NamesTheUnit) {
  EXPECT_NO_THROW(requirePositive("length", 1, kMetres));
  const auto of = [](double number, const Unit& unit) {
    return messageOf([&] { requirePositive("x", number, unit); });
  };
  EXPECT_EQ(of(-1, kMetres), "x: found -1 m, wanted a positive, finite number of metres");
  EXPECT_EQ(of(0, kSeconds), "x: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_EQ(of(kInfinity, kRadians), "x: found inf rad, wanted a positive, finite number of radians");
  EXPECT_EQ(of(kNan, kMetres), "x: found nan, wanted a positive, finite number of metres");
}

TEST(RequirePositiveOrInfinite, TakesInfinity) {
  EXPECT_NO_THROW(requirePositiveOrInfinite("range", kLeast));
  EXPECT_NO_THROW(requirePositiveOrInfinite("range", kInfinity, kMetres));
  const auto of = [](double number, const Unit& unit) {
    return messageOf([&] { requirePositiveOrInfinite("range", number, unit); });
  };
  EXPECT_EQ(of(0, kNoUnit), "range: found 0, wanted a positive number, or infinity");
  EXPECT_EQ(of(-2, kMetres), "range: found -2 m, wanted a positive number of metres, or infinity");
  EXPECT_EQ(of(-kInfinity, kNoUnit), "range: found -inf, wanted a positive number, or infinity");
  EXPECT_EQ(of(kNan, kMetres), "range: found nan, wanted a positive number of metres, or infinity");
}

TEST(RequireNotNegative, TakesZero) {
  EXPECT_NO_THROW(requireNotNegative("length", 0));
  EXPECT_NO_THROW(requireNotNegative("length", kMost, kMetres));
  const auto of = [](double number, const Unit& unit) {
    return messageOf([&] { requireNotNegative("length", number, unit); });
  };
  EXPECT_EQ(of(-1e-9, kNoUnit), "length: found -1e-09, wanted a finite number, 0 or more");
  EXPECT_EQ(of(-1, kMetres), "length: found -1 m, wanted a finite number of metres, 0 or more");
  EXPECT_EQ(of(kInfinity, kMetres), "length: found inf m, wanted a finite number of metres, 0 or more");
  EXPECT_EQ(of(-kInfinity, kNoUnit), "length: found -inf, wanted a finite number, 0 or more");
  EXPECT_EQ(of(kNan, kMetres), "length: found nan, wanted a finite number of metres, 0 or more");
}

TEST(RequireNotNegative, SaysWhichNumberOfAVector) {
  EXPECT_NO_THROW(requireNotNegative("weights", Eigen::Vector3d(0, 1, kMost)));
  EXPECT_NO_THROW(requireNotNegative("weights", Eigen::VectorXd()));
  EXPECT_EQ(messageOf([] { requireNotNegative("weights", Eigen::Vector3d(0, 1, -2)); }),
            "weights: number 2: found -2, wanted a finite number, 0 or more");
  EXPECT_EQ(messageOf([] { requireNotNegative("weights", Eigen::Vector2d(kInfinity, -1)); }),
            "weights: number 0: found inf, wanted a finite number, 0 or more");
  EXPECT_EQ(messageOf([] { requireNotNegative("weights", Eigen::Vector2d(0, kNan)); }),
            "weights: number 1: found nan, wanted a finite number, 0 or more");
}

TEST(RequireNotNegativeOrInfinite, TakesZeroAndInfinity) {
  EXPECT_NO_THROW(requireNotNegativeOrInfinite("range", 0));
  EXPECT_NO_THROW(requireNotNegativeOrInfinite("range", kInfinity, kMetres));
  const auto of = [](double number, const Unit& unit) {
    return messageOf([&] { requireNotNegativeOrInfinite("range", number, unit); });
  };
  EXPECT_EQ(of(-kLeast, kNoUnit), "range: found -4.94066e-324, wanted a number, 0 or more, or infinity");
  EXPECT_EQ(of(-2, kMetres), "range: found -2 m, wanted a number of metres, 0 or more, or infinity");
  EXPECT_EQ(of(-kInfinity, kNoUnit), "range: found -inf, wanted a number, 0 or more, or infinity");
  EXPECT_EQ(of(kNan, kMetres), "range: found nan, wanted a number of metres, 0 or more, or infinity");
}

TEST(RequireFinite, TakesFiniteNumbersOnly) {
  EXPECT_NO_THROW(requireFinite("mass", 0));
  EXPECT_NO_THROW(requireFinite("mass", -kMost, kMetres));
  const auto of = [](double number, const Unit& unit) {
    return messageOf([&] { requireFinite("time", number, unit); });
  };
  EXPECT_EQ(of(kInfinity, kNoUnit), "time: found inf, wanted a finite number");
  EXPECT_EQ(of(-kInfinity, kSeconds), "time: found -inf s, wanted a finite number of seconds");
  EXPECT_EQ(of(kNan, kSeconds), "time: found nan, wanted a finite number of seconds");
}

TEST(RequireFinite, SaysWhichNumberOfAVector) {
  EXPECT_NO_THROW(requireFinite("posture", Eigen::Vector3d(0, -1e300, kLeast)));
  EXPECT_NO_THROW(requireFinite("posture", Eigen::VectorXd()));
  EXPECT_EQ(messageOf([] { requireFinite("posture", Eigen::Vector3d(0, 1, kInfinity)); }),
            "posture: number 2: found inf, wanted a finite number");
  EXPECT_EQ(messageOf([] { requireFinite("posture", Eigen::Vector3d(0, kNan, kInfinity)); }),
            "posture: number 1: found nan, wanted a finite number");
}

TEST(Require, PrintsNoSignOfANan) {
  for (const double nan : {std::copysign(kNan, 1), std::copysign(kNan, -1)}) {
    EXPECT_REX_ERROR(requirePositive("x", nan), "x: found nan, wanted");
    EXPECT_REX_ERROR(requirePositiveOrInfinite("x", nan), "x: found nan, wanted");
    EXPECT_REX_ERROR(requireNotNegative("x", nan), "x: found nan, wanted");
    EXPECT_REX_ERROR(requireNotNegative("x", Eigen::Vector2d(0, nan)), "x: number 1: found nan, wanted");
    EXPECT_REX_ERROR(requireNotNegativeOrInfinite("x", nan), "x: found nan, wanted");
    EXPECT_REX_ERROR(requireFinite("x", nan), "x: found nan, wanted");
    EXPECT_REX_ERROR(requireFinite("x", Eigen::Vector2d(0, nan)), "x: number 1: found nan, wanted");
  }
}

TEST(RequireCount, TakesTheLeastCount) {
  EXPECT_NO_THROW(requireCount("steps", 0, 0));
  EXPECT_NO_THROW(requireCount("steps", 1, 1));
  EXPECT_NO_THROW(requireCount("steps", std::numeric_limits<long long>::max(), 2));
  const auto of = [](long long count, long long least) {
    return messageOf([&] { requireCount("steps", count, least); });
  };
  EXPECT_EQ(of(-1, 0), "steps: found -1, wanted 0 or more");
  EXPECT_EQ(of(0, 1), "steps: found 0, wanted at least 1");
  EXPECT_EQ(of(1, 2), "steps: found 1, wanted at least 2");
}

}  // namespace rex::require_test
