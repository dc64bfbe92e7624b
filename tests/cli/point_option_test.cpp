#include "cli/point_option.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::cli::point_option_test {

TEST(ParsePoint, TakesThreeNumbers) {
  EXPECT_EQ(parsePoint("1,-2, 0.5", "--point"), Eigen::Vector3d(1, -2, 0.5));
  EXPECT_REX_ERROR(parsePoint("1,2", "--point"), "--point: found 2 numbers, wanted three: x,y,z");
  EXPECT_REX_ERROR(parsePoint("1,2,z", "--point"), "--point: found 'z', wanted a number");
}

}  // namespace rex::cli::point_option_test
