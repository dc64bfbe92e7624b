#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "render/picture.h"
#include "support/expect_error.h"

namespace rex::covariance_ellipsoid_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The points of the ellipsoid are those of the unit sphere by this matrix, up to a turn of the sphere.
Matrix3d spread(const Ellipsoid& ellipsoid) {
  const Matrix3d axes = ellipsoid.X_WE.R * ellipsoid.radii.asDiagonal();
  return axes * axes.transpose();
}

TEST(CovarianceEllipsoid, HasTheRootsOfADiagonalAsRadii) {
  const Ellipsoid ellipsoid =
      covarianceEllipsoid({1, 2, 3}, Vector3d(0.04, 0.01, 0.09).asDiagonal(), 3, {1, 0, 0, 0.5f});
  EXPECT_EQ(ellipsoid.X_WE.p, Vector3d(1, 2, 3));
  EXPECT_LT((ellipsoid.radii - Vector3d(0.3, 0.6, 0.9)).norm(), 1e-12) << "smallest first";
  EXPECT_NEAR(std::abs(ellipsoid.X_WE.R(1, 0)), 1, 1e-12) << "the smallest variance is that of y";
  EXPECT_EQ(ellipsoid.color, (Color{1, 0, 0, 0.5f}));
}

TEST(CovarianceEllipsoid, TurnsWithItsCovariance) {
  Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d R = expSO3(rng.normalVector(3));
    const Vector3d radii = rng.uniformVector(3, 0, 2);
    Matrix3d covariance = R * radii.cwiseAbs2().asDiagonal() * R.transpose();
    covariance(0, 1) *= 1 + 1e-13;  // rounding of the caller
    const Ellipsoid ellipsoid = covarianceEllipsoid(Vector3d::Zero(), covariance, 1);
    EXPECT_LT((spread(ellipsoid) - covariance).norm(), 1e-11);
    EXPECT_LT((ellipsoid.X_WE.R.transpose() * ellipsoid.X_WE.R - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(ellipsoid.X_WE.R.determinant(), 1, 1e-12) << "a rotation, no mirror";
  }
}

TEST(CovarianceEllipsoid, MayBeFlatOrAPoint) {
  const Vector3d along = Vector3d(1, 2, 2) / 3;
  const Ellipsoid needle = covarianceEllipsoid(Vector3d::Zero(), 0.25 * along * along.transpose());
  EXPECT_NEAR(needle.radii.z(), 1, 1e-12);
  EXPECT_LT(needle.radii.head<2>().norm(), 1e-7);
  EXPECT_EQ(covarianceEllipsoid(Vector3d::Zero(), Matrix3d::Zero()).radii, Vector3d(0, 0, 0));
}

TEST(CovarianceEllipsoid, NamesWhatIsWrong) {
  const Vector3d zero = Vector3d::Zero();
  const Matrix3d good = Matrix3d::Identity();
  Matrix3d bad = good;
  bad(0, 1) = 0.1;
  EXPECT_REX_ERROR(covarianceEllipsoid(zero, bad),
                   "covariance ellipsoid: found a covariance that is not symmetric, wanted a symmetric one");
  bad(1, 0) = 2;
  bad(0, 1) = 2;
  EXPECT_REX_ERROR(covarianceEllipsoid(zero, bad), "along one axis, wanted variances >= 0");
  bad(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(covarianceEllipsoid(zero, bad), "found a mean or covariance that is not finite");
  EXPECT_REX_ERROR(covarianceEllipsoid(zero, good, 0),
                   "covariance ellipsoid: sigmas: found 0, wanted a positive, finite number");
}

}  // namespace rex::covariance_ellipsoid_test
