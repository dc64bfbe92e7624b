#include "base/require_finite.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::require_finite_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(RequireFinite, LetsNumbersPass) {
  EXPECT_NO_THROW(requireFinite("mass", std::numeric_limits<double>::max()));
  EXPECT_NO_THROW(requireFinite("posture", Eigen::Vector3d(0, -1e300, 5e-324)));
  EXPECT_NO_THROW(requireFinite("posture", Eigen::VectorXd()));
}

TEST(RequireFinite, NamesWhatIsNone) {
  EXPECT_REX_ERROR(requireFinite("mass", std::nan("")), "mass: found nan, wanted a finite number");
  EXPECT_REX_ERROR(requireFinite("mass", -std::nan("")), "mass: found nan");
  EXPECT_REX_ERROR(requireFinite("mass", -kInfinity), "mass: found -inf, wanted a finite number");
  EXPECT_REX_ERROR(requireFinite("posture", Eigen::Vector3d(0, 1, kInfinity)),
                   "posture: number 2: found inf, wanted a finite number");
}

}  // namespace rex::require_finite_test
