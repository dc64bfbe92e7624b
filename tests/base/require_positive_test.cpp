#include "base/require_positive.h"

#include <limits>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::require_positive_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(RequirePositive, TakesPositiveNumbersOnly) {
  requirePositive("mass", 1e-300);
  requirePositive("mass", 1e300);
  EXPECT_REX_ERROR(requirePositive("mass", 0), "mass: found 0, wanted a positive number");
  EXPECT_REX_ERROR(requirePositive("mass", -1), "mass: found -1, wanted a positive number");
  for (const double number : {kInfinity, -kInfinity, kNan})
    EXPECT_REX_ERROR(requirePositive("mass", number), "wanted a positive number");
}

TEST(RequireNotNegative, TakesZero) {
  requireNotNegative("length", 0);
  EXPECT_REX_ERROR(requireNotNegative("length", -1e-9),
                   "length: found -1e-09, wanted a number that is not negative");
  for (const double number : {kInfinity, -kInfinity, kNan})
    EXPECT_REX_ERROR(requireNotNegative("length", number), "wanted a number that is not negative");
}

}  // namespace rex::require_positive_test
