#include "render/camera.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::camera_test {

using Eigen::Vector3d;

TEST(Camera, PutsTheTargetInTheMiddleAndUpAbove) {
  const Camera camera = lookAt({0, -5, 1}, {0, 0, 1});
  const auto target = project(camera, {0, 0, 1}, 640, 480);
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->x, 320, 1e-9);
  EXPECT_NEAR(target->y, 240, 1e-9);
  EXPECT_NEAR(target->depth, 5, 1e-12);
  EXPECT_GT(project(camera, {1, 0, 1}, 640, 480)->x, 400);
  EXPECT_LT(project(camera, {0, 0, 2}, 640, 480)->y, 160);
  EXPECT_FALSE(project(camera, {0, -6, 1}, 640, 480));
}

TEST(Camera, LooksStraightDownWithoutTrouble) {
  const Camera camera = lookAt({0, 0, 3}, {0, 0, 0});
  EXPECT_TRUE(camera.X_WC.R.allFinite());
  EXPECT_LT((camera.X_WC.R.transpose() * camera.X_WC.R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT(project(camera, {1, 0, 0}, 100, 100)->y, 50);
}

TEST(Camera, ClipCoordinatesAgreeWithProject) {
  Rng rng(1);
  const Camera camera = lookAt({3, -4, 2}, {0.2, 0.1, 0.5});
  for (int i = 0; i < 50; ++i) {
    const Vector3d point = rng.normalVector(3);
    const Eigen::Vector4d clip = clipFromWorld(camera, 640. / 480) * point.homogeneous();
    const auto pixel = project(camera, point, 640, 480);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((clip.x() / clip.w() + 1) * 320, pixel->x, 1e-9);
    EXPECT_NEAR((1 - clip.y() / clip.w()) * 240, pixel->y, 1e-9);
    EXPECT_NEAR(clip.w(), pixel->depth, 1e-12);
  }
  const auto depthAt = [&](double distance) {
    const Vector3d point = camera.X_WC * Vector3d(0, 0, -distance);
    const Eigen::Vector4d clip = clipFromWorld(camera, 1) * point.homogeneous();
    return clip.z() / clip.w();
  };
  EXPECT_NEAR(depthAt(camera.nearPlane), -1, 1e-9);
  EXPECT_NEAR(depthAt(camera.farPlane), 1, 1e-9);
}

// The corners are inside the picture with a margin, fill it in one direction, and are centred in both.
TEST(Framing, FillsThePictureFromAnySide) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const int width = 100 + rng.index(900), height = 100 + rng.index(900);
    Bounds box;
    box.include(rng.normalVector(3));
    box.include(rng.normalVector(3));
    const Camera camera = framing(box, rng.normalVector(3), static_cast<double>(width) / height);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9, nearest = 1e9;
    for (int k = 0; k < 8; ++k) {
      const auto at = project(camera, box.corner(k), width, height);
      ASSERT_TRUE(at);
      EXPECT_GT(at->depth, camera.nearPlane);
      EXPECT_LT(at->depth, camera.farPlane);
      nearest = std::min(nearest, at->depth);
      left = std::min(left, at->x), right = std::max(right, at->x);
      top = std::min(top, at->y), bottom = std::max(bottom, at->y);
    }
    EXPECT_NEAR(left, width - right, 1e-6 * width);
    EXPECT_NEAR(top, height - bottom, 1e-6 * height);
    const double share = std::max((right - left) / width, (bottom - top) / height);
    EXPECT_LT(share, 1 / 1.12 + 1e-9);
    EXPECT_TRUE(share > 1 / 1.12 - 1e-9 || nearest < box.radius() + 1e-9);
  }
}

TEST(Framing, CanLookAtOnePoint) {
  Bounds box;
  box.include({1, 2, 3});
  const auto at = project(framing(box, kDefaultView, 1.5), {1, 2, 3}, 300, 200);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 150, 1e-9);
}

TEST(Camera, RejectsNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Bounds box;
  EXPECT_REX_ERROR(lookAt({1, 1, 1}, {1, 1, 1}), "camera: found eye (1, 1, 1) looking at (1, 1, 1)");
  EXPECT_REX_ERROR(lookAt({nan, 1, 1}, {1, 1, 1}), "wanted two different finite points");
  EXPECT_REX_ERROR(framing(box, kDefaultView, 1),
                   "nothing to draw: found no shape, line, point, arrow or label in the scene, wanted at "
                   "least one");
  box.include({0, 0, 0});
  EXPECT_REX_ERROR(framing(box, {0, 0, 0}, 1), "found no view direction");
  EXPECT_REX_ERROR(framing(box, kDefaultView, 0), "found a strange aspect ratio");
  box.include({0, 0, std::numeric_limits<double>::infinity()});
  EXPECT_REX_ERROR(framing(box, kDefaultView, 1), "found infinite bounds");
}

}  // namespace rex::camera_test
