// Lines, points, axes and text over the scene.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/frame_buffer_internal.h"
#include "render/renderer.h"
#include "render/text.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"

namespace rex::overlay_test {

using Eigen::Vector3d;

constexpr int kWidth = 320, kHeight = 240;
constexpr Color kRed{1, 0, 0}, kBlack{0, 0, 0};

Picture blank() {
  Picture picture;
  picture.ground.visible = false;
  return picture;
}

Camera fromSouth() { return lookAt({0, -6, 0}, {0, 0, 0}); }

Image drawn(const Picture& picture, const Camera& camera = fromSouth()) {
  const Color white{1, 1, 1};
  Renderer renderer({.width = kWidth, .height = kHeight, .backgroundTop = white, .backgroundBottom = white});
  return renderer.draw(picture, camera);
}

// How far the white background has turned red, 0 to 1.
double redness(const Image& image, int x, int y) { return 1 - image.at(x, y)[1] / 255.0; }

double totalRedness(const Image& image) {
  double total = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) total += redness(image, x, y);
  return total;
}

TEST(Polyline, RunsThroughItsPointsWithItsWidth) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  Polyline circle{.color = kRed, .width = 4};
  for (int i = 0; i <= 100; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    circle.points.emplace_back(std::cos(angle), 0, std::sin(angle));
  }
  picture.polylines.push_back(circle);
  const Image image = drawn(picture);
  for (const Vector3d& point : circle.points) {
    const auto at = project(fromSouth(), point, kWidth, kHeight);
    EXPECT_GT(redness(image, static_cast<int>(at->x), static_cast<int>(at->y)), 0.9);
  }
  const double radius = project(fromSouth(), {1, 0, 0}, kWidth, kHeight)->x - kWidth / 2.0;
  EXPECT_NEAR(totalRedness(image), 2 * std::numbers::pi * radius * 4, 0.05 * totalRedness(image));
}

TEST(Polyline, HasNoDarkJointsWhenTranslucent) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  Polyline line{.color = {1, 0, 0, 0.5f}, .width = 9};
  for (int i = 0; i <= 20; ++i) line.points.emplace_back(-1 + 0.1 * i, 0, 0.2 * std::sin(0.5 * i));
  picture.polylines.push_back(line);
  const Image image = drawn(picture);
  double darkest = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) darkest = std::max(darkest, redness(image, x, y));
  EXPECT_NEAR(darkest, 0.5, 0.03);
}

TEST(Polyline, IsCutWhereItPassesTheCamera) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.polylines.push_back(
      {.points = {{0, 10, 0.2}, {0, -20, 0.2}, {1, -30, 0}, {0.3, 0, 0}}, .color = kRed});
  const Image image = drawn(picture);
  const auto at = project(fromSouth(), {0, 5, 0.2}, kWidth, kHeight);
  EXPECT_GT(redness(image, static_cast<int>(at->x), static_cast<int>(at->y)), 0.5);
}

TEST(Polyline, MayTurnBackOrStandStill) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.polylines.push_back({.points = {{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, .color = kRed, .width = 4});
  picture.polylines.push_back({.points = {{0, 0, 1}, {0, 0, 1}}, .color = kRed, .width = 8});
  picture.polylines.push_back({.points = {{0, 0, -1}}, .color = kRed, .width = 8});
  const Image image = drawn(picture);
  const auto still = project(fromSouth(), {0, 0, 1}, kWidth, kHeight);
  EXPECT_GT(redness(image, static_cast<int>(still->x), static_cast<int>(still->y)), 0.9);
  const double length = 2 * (project(fromSouth(), {1, 0, 0}, kWidth, kHeight)->x - kWidth / 2.0);
  EXPECT_NEAR(totalRedness(image), 4 * length + 2 * 12.6 + 50, 0.06 * totalRedness(image));
}

TEST(Overlay, ShowsFaintlyThroughSolids) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.solids.push_back({{ShapeType::kBox, {1, 0.1, 1}, 0}, {}, {1, 1, 1}, "wall"});
  picture.polylines.push_back({.points = {{-2, 1, 0}, {2, 1, 0}}, .color = kRed, .width = 6});
  picture.pointSets.push_back({.points = {{0, -1, 0.2}}, .color = kRed, .size = 8});
  const Image image = drawn(picture);
  const double wall = redness(image, kWidth / 2 - 20, kHeight / 2 - 20);
  const double hidden = redness(image, kWidth / 2, kHeight / 2);
  EXPECT_GT(hidden, wall + 0.1);
  EXPECT_LT(hidden, 0.6);
  EXPECT_GT(redness(image, kWidth / 2 + 80, kHeight / 2), 0.9);
  const auto front = project(fromSouth(), {0, -1, 0.2}, kWidth, kHeight);
  EXPECT_GT(redness(image, static_cast<int>(front->x), static_cast<int>(front->y)), 0.9);
}

TEST(PointSet, DrawsRoundDiscsOfItsSize) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.pointSets.push_back({.points = {{0, 0, 0}, {1, 3, 0.5}, {0, -9, 0}}, .color = kRed, .size = 14});
  const Image image = drawn(picture);
  EXPECT_NEAR(totalRedness(image), 2 * std::numbers::pi * 49, 12);
  EXPECT_LT(redness(image, kWidth / 2 + 6, kHeight / 2 + 6), 0.05) << "round, not square";
}

TEST(Axes, PointAlongTheirFrameInRedGreenBlue) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  const Pose X_WF{.R = Eigen::Matrix3d::Identity(), .p = {0.3, 0.2, -0.1}};
  picture.axes.push_back({X_WF, 1, ""});
  picture.solids.push_back({{ShapeType::kMarker, {2, 2, 2}, 0}, translation(-0.8, 0, 0), {}, "marker"});
  const Camera camera = lookAt({3, -5, 2}, {0, 0, 0});
  const Image image = drawn(picture, camera);
  const auto strongest = [&](const Vector3d& p_WQ) {
    const auto at = project(camera, p_WQ, kWidth, kHeight);
    const auto rgb = image.at(static_cast<int>(at->x), static_cast<int>(at->y));
    return std::max_element(rgb.begin(), rgb.end()) - rgb.begin();
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(strongest(X_WF.p + 0.8 * X_WF.R.col(i)), i);
    EXPECT_EQ(strongest(Vector3d(-0.8, 0, 0) - 0.8 * Vector3d::Unit(i)), i) << "a marker has both sides";
  }
}

struct Extent {
  int left = kWidth, right = 0, top = kHeight, bottom = 0;
};

// Where the picture differs from one without text. Both show a point, for neither may be blank.
Extent changed(Picture picture) {
  picture.pointSets.push_back({.points = {{0, 0, 0}}});
  Picture bare = blank();
  bare.pointSets = picture.pointSets;
  const Image image = drawn(picture), empty = drawn(bare);
  Extent extent;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (image.at(x, y) == empty.at(x, y)) continue;
      extent.left = std::min(extent.left, x), extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y), extent.bottom = std::max(extent.bottom, y);
    }
  return extent;
}

TEST(Label, StandsBesideItsPoint) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.labels.push_back({"hand", {0.5, 0, 0.5}, kBlack});
  const auto at = project(fromSouth(), {0.5, 0, 0.5}, kWidth, kHeight);
  const TextSize size = textSize("hand");
  Extent extent = changed(picture);
  EXPECT_NEAR(extent.left, at->x + 8, 4);
  EXPECT_NEAR(extent.right, at->x + 8 + size.width, 5);
  EXPECT_NEAR((extent.top + extent.bottom) / 2.0, at->y, 4);
  // At the right border it moves to the left of the point.
  picture.labels[0].p_WQ = {2.4, 0, 0};
  extent = changed(picture);
  EXPECT_LT(extent.right, project(fromSouth(), {2.4, 0, 0}, kWidth, kHeight)->x);
}

TEST(Label, IsLeftOutWhereItsPointIsNotSeen) {
  REX_NEEDS_OSMESA();
  Picture picture = blank();
  picture.labels = {{"behind", {0, -9, 0}}, {"beside", {1e9, 0, 0}}, {"below", {0, 0, -50}}, {"", {0, 0, 0}}};
  EXPECT_EQ(changed(picture).right, 0);
}

TEST(Caption, StandsInItsCorner) {
  REX_NEEDS_OSMESA();
  for (const Corner corner :
       {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight}) {
    Picture picture = blank();
    picture.captions.push_back({"two\nlines", corner, kBlack});
    picture.captions.push_back({"and one", corner, kBlack});
    const Extent extent = changed(picture);
    const bool left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
    const bool top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
    EXPECT_NEAR(left ? extent.left : kWidth - extent.right, 8, 5);
    EXPECT_NEAR(top ? extent.top : kHeight - extent.bottom, 9, 6);
    EXPECT_NEAR(extent.bottom - extent.top, 3 * textSize("").height, 8);
  }
}

TEST(FrameBuffer, RefusesSizesBeyondOpenGl) {
  REX_NEEDS_OSMESA();
  const auto context = makeGlContext();
  context->makeCurrent();
  const internal::GlFunctions gl = internal::loadGlFunctions(*context);
  EXPECT_REX_ERROR(
      internal::FrameBuffer(gl, 100000, 100000, {.samples = 4}),
      "OpenGL cannot draw a picture of this size: found 100000 x 100000 pixels, 4 samples, wanted "
      "a smaller one");
}

}  // namespace rex::overlay_test
