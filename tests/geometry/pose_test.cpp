#include "geometry/pose.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "geometry/shape.h"

namespace rex::pose_test {

Pose randomPose(Rng& rng) { return {expSO3(rng.normalVector(3)), rng.normalVector(3)}; }

TEST(Pose, IsAGroup) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const Pose a = randomPose(rng), b = randomPose(rng), c = randomPose(rng);
    EXPECT_TRUE(isApprox((a * b) * c, a * (b * c), 1e-13));
    EXPECT_TRUE(isApprox(a * a.inverse(), Pose{}, 1e-14));
    EXPECT_TRUE(isApprox(a * Pose{}, a, 0));
    const Eigen::Vector3d point = rng.normalVector(3);
    EXPECT_LT((a * (b * point) - (a * b) * point).norm(), 1e-13);
  }
}

// Other tests believe it.
TEST(Pose, IsNotApproximatelyWhatIsBeyondTheTolerance) {
  Rng rng(2);
  constexpr double kTolerance = 1e-6;
  for (int k = 0; k < 12; ++k) {
    const Pose a = randomPose(rng);
    for (const double share : {0.9, 1.1, -0.9, -1.1}) {
      Pose b = a;
      (k < 9 ? b.R(k / 3, k % 3) : b.p[k - 9]) += share * kTolerance;
      EXPECT_EQ(isApprox(a, b, kTolerance), std::abs(share) < 1) << k << " " << share;
    }
  }
}

TEST(Pose, MovesThenTurnsInTheNewFrame) {
  const Pose X = translation(1, 0, 0) * rotation(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  EXPECT_LT((X * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 1, 0)).norm(), 1e-15);
  EXPECT_TRUE(isApprox(rotation(1, Eigen::Vector3d::Zero()), Pose{}, 0));
}

TEST(HalfBounds, HoldTheSolid) {
  EXPECT_EQ(halfBounds({ShapeType::kBox, {1, 2, 3}, 0}), Eigen::Vector3d(0.5, 1, 1.5));
  EXPECT_EQ(halfBounds({ShapeType::kSphere, {9, 9, 9}, 2}), Eigen::Vector3d(2, 2, 2));
  EXPECT_EQ(halfBounds({ShapeType::kCapsule, {9, 9, 2}, 0.5}), Eigen::Vector3d(0.5, 0.5, 1.5));
  EXPECT_EQ(halfBounds({ShapeType::kCylinder, {9, 9, 2}, 0.5}), Eigen::Vector3d(0.5, 0.5, 1));
  EXPECT_EQ(halfBounds({ShapeType::kCone, {9, 9, 2}, 0.5}), Eigen::Vector3d(0.5, 0.5, 1));
  EXPECT_EQ(halfBounds({ShapeType::kEllipsoid, {2, 4, 6}}), Eigen::Vector3d(1, 2, 3));
}

}  // namespace rex::pose_test
