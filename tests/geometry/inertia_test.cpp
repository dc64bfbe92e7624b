#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/mesh_mass.h"
#include "geometry/rotation.h"
#include "support/nearest_inertia.h"

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

TEST(PrincipalMoments, AreThoseAboutThePrincipalAxes) {
  Rng rng(3);
  for (int round = 0; round < 20; ++round) {
    const Matrix3d R = rotationFromRollPitchYaw(rng.normalVector(3));
    EXPECT_LT((principalMoments(R * diagonal(3, -1, 2) * R.transpose()) - Vector3d(-1, 2, 3)).norm(), 1e-14);
  }
}

TEST(NearestWithoutNegativeMoments, IsNearest) {
  Rng rng(4);
  for (int round = 0; round < 100; ++round) {
    Matrix3d I = Matrix3d::Zero();
    for (int row = 0; row < 3; ++row) I.row(row) = rng.normalVector(3).transpose();
    I = (I + I.transpose()).eval() * std::pow(10, rng.uniform(-30, 3));
    const Matrix3d nearest = nearestWithoutNegativeMoments(I);
    EXPECT_TRUE(isNearestInertia(nearest, I)) << I << "\n\n" << nearest;
    EXPECT_NE(inertiaFault(nearest), InertiaFault::kNegative);
  }
  EXPECT_TRUE(nearestWithoutNegativeMoments(diagonal(-1, -2, -3)).isZero(0));
  EXPECT_FALSE(isNearestInertia(diagonal(0, 1, 2.1), diagonal(-1, 1, 2)));
}

}  // namespace rex::inertia_test
