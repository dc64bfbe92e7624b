#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "grasping/object_surface.h"
#include "support/expect_error.h"

namespace rex::contact_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Contact, HasAFrameThatBeginsWithTheNormal) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d n = rng.normalVector(3).normalized();
    const Eigen::Matrix3d R = contactFrame(Contact{.normal_O = n});
    EXPECT_TRUE(R.col(0).isApprox(n, 1e-15));
    EXPECT_TRUE((R.transpose() * R).isIdentity(1e-14));
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
    const Vector2d flat = rng.normalVector(2).normalized();
    const Eigen::Matrix2d R2 = contactFrame(PlanarContact{.normal_O = flat});
    EXPECT_TRUE(R2.col(0).isApprox(flat, 1e-15));
    EXPECT_NEAR(R2.determinant(), 1, 1e-14);
    EXPECT_TRUE((R2.transpose() * R2).isIdentity(1e-14));
  }
}

TEST(Contact, HasTangentsAlongTheAxesWhereItsNormalIs) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.}) {
      const Eigen::Matrix3d R = contactFrame(Contact{.normal_O = sign * Vector3d::Unit(axis)});
      EXPECT_EQ((R.array() == 0).count(), 6);
      EXPECT_EQ((R.array().abs() == 1).count(), 3);
    }
}

TEST(Contact, RefusesWhatIsNone) {
  EXPECT_REX_ERROR(requireValid(Contact{.p_OC = {0, std::nan(""), 0}}),
                   "contact: position: number 1: found nan");
  EXPECT_REX_ERROR(requireValid(Contact{.normal_O = {0, 0, HUGE_VAL}}),
                   "contact: normal: number 2: found inf");
  EXPECT_REX_ERROR(requireValid(Contact{.friction = HUGE_VAL}), "contact: friction: found inf");
  EXPECT_REX_ERROR(requireValid(Contact{.normal_O = {0, 0, 2}}),
                   "contact: length of the normal: found 2, wanted 1");
  EXPECT_REX_ERROR(requireValid(PlanarContact{.normal_O = {0, 0}}),
                   "contact: length of the normal: found 0, wanted 1");
  EXPECT_REX_ERROR(requireValid(PlanarContact{.friction = -0.5}),
                   "contact: friction: found -0.5, wanted a finite number, 0 or more");
}

}  // namespace rex::contact_test
