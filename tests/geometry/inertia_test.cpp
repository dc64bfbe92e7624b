#include "geometry/inertia.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"

namespace rex::inertia_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d diagonal(double x, double y, double z) { return Vector3d(x, y, z).asDiagonal(); }

TEST(InertiaFault, IsNoneForPointMasses) {
  Rng rng(1);
  for (int round = 0; round < 100; ++round) {
    Matrix3d I = Matrix3d::Zero();
    for (int point = 0; point < 1 + round % 5; ++point) {
      const Vector3d p = rng.normalVector(3);
      I += rng.uniform(0, 2) * (p.squaredNorm() * Matrix3d::Identity() - p * p.transpose());
    }
    EXPECT_EQ(inertiaFault(I), InertiaFault::kNone);
  }
  EXPECT_EQ(inertiaFault(Matrix3d::Zero()), InertiaFault::kNone);
}

TEST(InertiaFault, DoesNotDependOnTheFrame) {
  Rng rng(2);
  for (int round = 0; round < 20; ++round) {
    const Matrix3d R = expSO3(rng.normalVector(3));
    EXPECT_EQ(inertiaFault(R * diagonal(1, 2, 2.9) * R.transpose()), InertiaFault::kNone);
    EXPECT_EQ(inertiaFault(R * diagonal(1, 2, 3.1) * R.transpose()), InertiaFault::kTriangle);
    EXPECT_EQ(inertiaFault(R * diagonal(-0.1, 2, 2) * R.transpose()), InertiaFault::kNegative);
  }
}

TEST(InertiaFault, ForgivesRounding) {
  EXPECT_EQ(inertiaFault(diagonal(1e-3, 1e-3, 2.000001e-3)), InertiaFault::kNone);
  EXPECT_EQ(inertiaFault(diagonal(-1e-12, 1, 1)), InertiaFault::kNone);
}

}  // namespace rex::inertia_test
