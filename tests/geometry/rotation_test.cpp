#include "geometry/rotation.h"

#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/pose.h"
#include "support/expect_error.h"

namespace rex::rotation_test {

using std::numbers::pi;

// Rotation vectors at which every law must hold: zero, tiny, either side of each series' end, random, and
// near pi.
std::vector<Eigen::Vector3d> rotationVectors() {
  Rng rng(11);
  std::vector<Eigen::Vector3d> vectors = {Eigen::Vector3d::Zero()};
  for (double length : {1e-12, 1e-8, 0.99e-4, 1.01e-4, 0.099, 0.101, 1., 3., pi - 1e-6, pi - 1e-9}) {
    for (int i = 0; i < 10; ++i) vectors.emplace_back(length * rng.normalVector(3).normalized());
  }
  return vectors;
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(RotationVector, ExpIsARotationAndAgreesWithEigen) {
  for (const Eigen::Vector3d& w : rotationVectors()) {
    const Eigen::Matrix3d R = expSO3(w);
    EXPECT_LT(distance(R * R.transpose(), Eigen::Matrix3d::Identity()), 1e-14) << w.transpose();
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
    if (w.norm() > 0) {
      const Eigen::Matrix3d peer = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
      EXPECT_LT(distance(R, peer), 1e-14) << w.transpose();
      EXPECT_LT(distance(rotationAboutAxis(w.norm(), 5 * w), peer), 1e-14);
    }
  }
}

TEST(RotationVector, LogInvertsExp) {
  for (const Eigen::Vector3d& w : rotationVectors()) {
    // Near pi the matrix determines the axis to about sqrt(eps)^2 / (pi - angle) only up to sign: compare
    // rotations.
    EXPECT_LT(distance(expSO3(logSO3(expSO3(w))), expSO3(w)), 1e-13) << w.transpose();
    if (w.norm() < 3.1) {
      EXPECT_LT(distance(logSO3(expSO3(w)), w), 1e-13 * std::max(1., w.norm())) << w.transpose();
    }
  }
  EXPECT_NEAR(logSO3(Eigen::Vector3d(-1, -1, 1).asDiagonal()).norm(), pi, 1e-15);
}

TEST(RotationVector, RightJacobianIsTheDerivativeOfExp) {
  for (const Eigen::Vector3d& w : rotationVectors()) {
    Eigen::Matrix3d numeric;
    const double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(i);
      numeric.col(i) =
          (logSO3(expSO3(w).transpose() * expSO3(w + d)) - logSO3(expSO3(w).transpose() * expSO3(w - d))) /
          (2 * h);
    }
    EXPECT_LT(distance(rightJacobianSO3(w), numeric), 1e-9) << w.transpose();
    EXPECT_LT(distance(leftJacobianSO3(w), expSO3(w) * rightJacobianSO3(w)), 1e-13);
  }
}

TEST(Quaternion, RoundTripsThroughMatrices) {
  for (const Eigen::Vector3d& w : rotationVectors()) {
    const Quaternion q = quaternionFromRotation(expSO3(w));
    EXPECT_GE(q[0], 0);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT(distance(rotationFromQuaternion(q), expSO3(w)), 1e-14);
    EXPECT_LT(distance(rotationFromQuaternion(-7 * q), expSO3(w)), 1e-14) << "length and sign do not matter";
  }
  for (int axis = 0; axis < 3; ++axis) {  // half turns: w = 0, where the slide's formula divides by zero
    const Eigen::Matrix3d R = rotationAboutAxis(pi, Eigen::Vector3d::Unit(axis));
    EXPECT_NEAR(quaternionFromRotation(R)[1 + axis], 1, 1e-15);
  }
}

TEST(Quaternion, ProductComposesRotations) {
  Rng rng(12);
  for (int i = 0; i < 100; ++i) {
    const Quaternion a = rng.normalVector(4), b = rng.normalVector(4);
    EXPECT_LT(distance(rotationFromQuaternion(quaternionProduct(a, b)),
                       rotationFromQuaternion(a) * rotationFromQuaternion(b)),
              1e-13);
  }
}

TEST(Quaternion, RefusesZeroAndNaN) {
  EXPECT_REX_ERROR(rotationFromQuaternion(Quaternion::Zero()),
                   "quaternion: found (0, 0, 0, 0), wanted finite");
  EXPECT_REX_ERROR(rotationFromQuaternion(Quaternion(std::nan(""), 0, 0, 1)),
                   "quaternion: found (nan, 0, 0, 1)");
}

TEST(RollPitchYaw, RoundTripsAndMatchesItsDefinition) {
  Rng rng(13);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d rpy = rng.uniformVector(3, -1.5, 1.5);
    EXPECT_LT(distance(rollPitchYawFromRotation(rotationFromRollPitchYaw(rpy)), rpy), 1e-13);
  }
  for (double off :
       {0., 1e-16, 1e-13, 1e-10, 1e-7, 1e-4}) {  // near gimbal lock the rotation still comes back
    for (double pitch : {pi / 2 - off, off - pi / 2}) {
      const Eigen::Matrix3d R =
          expSO3(Eigen::Vector3d(0, 0, 0.8)) * rotationFromRollPitchYaw({0.3, pitch, 0});
      EXPECT_LT(distance(rotationFromRollPitchYaw(rollPitchYawFromRotation(R)), R), 2e-15) << off;
    }
  }
  Eigen::Matrix3d yaw90;
  yaw90 << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LT(distance(rotationFromRollPitchYaw({0, 0, pi / 2}), yaw90), 1e-15);
}

TEST(RotationBetween, TurnsOneDirectionToTheOther) {
  Rng rng(14);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d a = rng.normalVector(3),
                          b = i < 5 ? Eigen::Vector3d(-2 * a) : Eigen::Vector3d(rng.normalVector(3));
    EXPECT_LT(distance(rotationBetween(a, b) * a.normalized(), b.normalized()), 1e-14);
  }
  EXPECT_EQ(rotationBetween({0, 0, 2}, {0, 0, 3}), Eigen::Matrix3d::Identity());
  EXPECT_REX_ERROR(rotationBetween({0, 0, 0}, {0, 0, 1}),
                   "rotation between two directions: found a zero vector");
}

TEST(Rotations, AreProperForVectorsOfAnyLength) {
  for (const double length : {5e-324, 1e-200, 1e-160, 1., 1e160, 1.7e308}) {
    const Eigen::Vector3d axis(0, length, length);
    EXPECT_LT(distance(rotationAboutAxis(0.3, axis), rotationAboutAxis(0.3, {0, 1, 1})), 1e-15) << length;
    EXPECT_LT(distance(rotationFromQuaternion(Quaternion(length, 0, 0, -length)),
                       rotationAboutAxis(-pi / 2, Eigen::Vector3d::UnitZ())),
              1e-15);
    EXPECT_LT(distance(rotationBetween(axis, {length, 0, 0}) * Eigen::Vector3d(0, 1, 1).normalized(),
                       Eigen::Vector3d::UnitX()),
              1e-15);
  }
}

TEST(WrapAngle, StaysInTheHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrapAngle(pi), pi);
  EXPECT_DOUBLE_EQ(wrapAngle(-pi), pi);
  EXPECT_NEAR(wrapAngle(7), 7 - 2 * pi, 1e-15);
  EXPECT_NEAR(wrapAngle(-100), -100 + 32 * pi, 1e-13);
}

TEST(SE3, ExpAndLogInvertEachOtherAndFollowTheFlow) {
  Rng rng(15);
  for (const Eigen::Vector3d& w : rotationVectors()) {
    if (w.norm() > 3.1) continue;
    Vector6d twist;
    twist << rng.normalVector(3), w;
    EXPECT_LT(distance(logSE3(expSE3(twist)), twist), 1e-12) << twist.transpose();
    // Second opinion: many small steps along the same twist end at the same pose.
    Pose X;
    const Pose step{expSO3(w / 4096), expSE3(twist / 4096).p};
    for (int i = 0; i < 4096; ++i) X = X * step;
    EXPECT_TRUE(isApprox(X, expSE3(twist), 1e-10)) << twist.transpose();
  }
}

TEST(SE2, AgreesWithSE3InThePlane) {
  Rng rng(16);
  for (double w : {0., 1e-8, 0.99e-4, 1.01e-4, 0.5, -2., 3.1}) {
    const Eigen::Vector3d twist(rng.normal(), rng.normal(), w);
    Vector6d spatial = Vector6d::Zero();
    spatial << twist[0], twist[1], 0, 0, 0, w;
    const Eigen::Vector3d pose = expSE2(twist);
    EXPECT_LT(distance(pose.head<2>(), expSE3(spatial).p.head<2>()), 1e-14);
    EXPECT_LT(distance(logSE2(pose), twist), 1e-12);
  }
}

TEST(IsRotation, AllowsForRoundingOnly) {
  const Eigen::Matrix3d R = rotationAboutAxis(1, {1, 2, 3});
  EXPECT_TRUE(isRotation(R));
  EXPECT_TRUE(isRotation(R.cast<float>().cast<double>()));
  EXPECT_FALSE(isRotation(1.00001 * R));
  EXPECT_FALSE(isRotation(-R));
}

}  // namespace rex::rotation_test
