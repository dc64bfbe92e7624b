// What algorithms add to a scene: arrows, ellipsoids, trees of lines, and labels among them.
#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "render/renderer.h"
#include "render/text.h"
#include "support/image_difference.h"
#include "support/needs_osmesa.h"

namespace rex::marks_test {

using Eigen::Vector3d;

constexpr int kWidth = 320, kHeight = 240;
constexpr Color kRed{0.9f, 0.1f, 0.1f};

Camera fromSouth() { return lookAt({0, -6, 0}, {0, 0, 0}); }

Image drawn(Picture picture, const Camera& camera = fromSouth(), bool ground = false) {
  picture.ground.visible = ground;
  return Renderer({.width = kWidth, .height = kHeight}).draw(picture, camera);
}

bool isRed(const Image& image, int x, int y) { return image.at(x, y)[0] > image.at(x, y)[1] + 60; }

int redInColumn(const Image& image, int x) {
  int red = 0;
  for (int y = 0; y < image.height; ++y) red += isRed(image, x, y) ? 1 : 0;
  return red;
}

TEST(Arrow, RunsFromPointToPointWithAHeadThreeTimesAsThick) {
  REX_NEEDS_OSMESA();
  const Image image = drawn({.arrows = {{{-1, 0, 0}, {1, 0, 0}, kRed, 0.05}}});
  const auto column = [](double x) {
    return static_cast<int>(project(fromSouth(), {x, 0, 0}, kWidth, kHeight)->x);
  };
  const double perMetre = project(fromSouth(), {1, 0, 0}, kWidth, kHeight)->x - kWidth / 2.0;
  EXPECT_EQ(redInColumn(image, column(-1.03)), 0);
  EXPECT_NEAR(redInColumn(image, column(-0.97)), 0.1 * perMetre, 1.5);
  EXPECT_NEAR(redInColumn(image, column(0.5)), 0.1 * perMetre, 1.5);
  EXPECT_NEAR(redInColumn(image, column(0.62)), 0.3 * perMetre, 2) << "the head is 8 radii long";
  EXPECT_NEAR(redInColumn(image, column(0.8)), 0.15 * perMetre, 2);
  EXPECT_EQ(redInColumn(image, column(1.03)), 0);
}

TEST(Arrow, PointsAnyWay) {
  REX_NEEDS_OSMESA();
  Rng rng(6);
  std::vector<Vector3d> ways = {{0, 0, 1}, {0, 0, -1}, {0, 0.3, -1}};
  for (int i = 0; i < 5; ++i) ways.emplace_back(rng.normalVector(3));
  for (const Vector3d& way : ways) {
    const Vector3d from(0.1, 0.2, -0.1), to = from + 0.9 * way.normalized();
    const Camera camera = lookAt({4, -5, 3}, {0, 0, 0});
    const Image image = drawn({.arrows = {{from, to, kRed, 0.04}}}, camera);
    for (const double share : {0.02, 0.5, 0.8, 0.95}) {
      const auto at = project(camera, from + share * (to - from), kWidth, kHeight);
      EXPECT_TRUE(isRed(image, static_cast<int>(at->x), static_cast<int>(at->y))) << way.transpose();
    }
  }
}

TEST(Arrow, IsSmallerWhenShortAndNothingWithoutLength) {
  REX_NEEDS_OSMESA();
  Picture picture{.arrows = {{{-0.5, 0, 0}, {0, 0, 0}, kRed, 0.3}, {{1, 0, 0}, {1, 0, 0}, kRed, 0.3}}};
  const Image image = drawn(picture);
  int highest = 0, columns = 0;
  for (int x = 0; x < kWidth; ++x) {
    highest = std::max(highest, redInColumn(image, x));
    columns += redInColumn(image, x) > 0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(highest) / columns, 0.5, 0.1) << "a head of 6 radii on 12 radii";
}

// The camera stands 0.4 metres before the end of a long shaft.
TEST(Arrow, IsRoundWhereItIsNear) {
  REX_NEEDS_OSMESA();
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  const Image image = drawn({.arrows = {{{0, -5.6, 0}, {0, 30, 0}, {0, 0, 0}, 0.1}}}, camera);
  const double pixels = 0.1 / 0.4 * kHeight / (2 * std::tan(camera.verticalFov / 2));
  int dark = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) dark += image.at(x, y)[0] < 128 ? 1 : 0;
  EXPECT_NEAR(dark, std::numbers::pi * pixels * pixels, 2 * std::numbers::pi * pixels * 0.5);
}

TEST(Arrow, CastsAShadow) {
  REX_NEEDS_OSMESA();
  Picture picture{.arrows = {{{-0.5, 0, 0.5}, {0.5, 0, 0.5}, kRed, 0.05}}};
  picture.toLight = {0, 0, 1};
  const Camera camera = lookAt({0, -3, 2}, {0, 0, 0});
  const auto groundUnder = [&](double x) {
    const auto at = project(camera, {x, 0, 0}, kWidth, kHeight);
    return drawn(picture, camera, true).at(static_cast<int>(at->x), static_cast<int>(at->y))[1];
  };
  EXPECT_LT(groundUnder(0), groundUnder(1.2) - 25);
}

TEST(Ellipsoid, OfEqualRadiiIsASphere) {
  REX_NEEDS_OSMESA();
  const Pose X{expSO3(Vector3d(1, 2, 3)), {0.2, 0, 0.1}};
  const Image ellipsoid = drawn({.ellipsoids = {{X, {0.5, 0.5, 0.5}, kRed}}});
  EXPECT_EQ(ellipsoid, drawn({.solids = {{{.type = ShapeType::kSphere, .radius = 0.5}, X, kRed, "ball"}}}));
}

TEST(Ellipsoid, ReachesAsFarAsItsRadii) {
  REX_NEEDS_OSMESA();
  const Ellipsoid ellipsoid{rotation(0.5, {0, 1, 0}), {0.9, 0.2, 0.3}, kRed};
  Camera far = lookAt({0, -60, 0}, {0, 0, 0});
  far.verticalFov /= 10;
  const Image image = drawn({.ellipsoids = {ellipsoid}}, far);
  const double perMetre = project(far, {1, 0, 0}, kWidth, kHeight)->x - kWidth / 2.0;
  int left = kWidth, right = 0, count = 0;
  for (int x = 0; x < kWidth; ++x) {
    const int red = redInColumn(image, x);
    count += red;
    if (red > 0) left = std::min(left, x), right = x;
  }
  const double reach = std::hypot(0.9 * std::cos(0.5), 0.3 * std::sin(0.5));
  EXPECT_NEAR(right - left + 1, 2 * reach * perMetre, 2.5);
  EXPECT_NEAR(count, std::numbers::pi * 0.9 * 0.3 * perMetre * perMetre, 0.03 * count);
  const auto redOf = [&](const Vector3d& radii) {
    const Image needle = drawn({.ellipsoids = {{{}, radii, kRed}}}, far);
    int red = 0;
    for (int x = 0; x < kWidth; ++x) red += redInColumn(needle, x);
    return red;
  };
  const int lying = redOf({0.9, 0.1, 0.1});
  EXPECT_NEAR(redOf({0.1, 0.1, 0.9}), lying, 0.02 * lying) << "upright";
}

TEST(Ellipsoid, LetsThroughWhatItsOpacityLeaves) {
  REX_NEEDS_OSMESA();
  const Picture behind{
      .solids = {{{ShapeType::kBox, {9, 0.1, 9}, 0}, translation(0, 2, 0), {1, 1, 1}, "wall"}}};
  const auto middle = [](const Picture& picture) { return drawn(picture).at(kWidth / 2, kHeight / 2); };
  Picture picture = behind;
  picture.ellipsoids = {{{}, {0.8, 0.5, 0.6}, {0, 0, 0, 0.5f}}};
  EXPECT_NEAR(middle(picture)[1], middle(behind)[1] / 2, 12) << "black, half of it";
  EXPECT_NEAR(middle(picture)[1], middle(picture)[0], 3);
  picture.ellipsoids = {{{}, {0.8, 0, 0.6}, {0, 0, 0, 0.5f}}};
  EXPECT_LT(middle(picture)[1], middle(behind)[1] - 60) << "a flat one is a thin lens";
  picture.ellipsoids[0].radii.setZero();
  EXPECT_EQ(drawn(picture), drawn(behind)) << "a point is nothing";
}

TEST(Ellipsoid, CastsNoShadow) {
  REX_NEEDS_OSMESA();
  const Picture picture{.ellipsoids = {{translation(0, 0, 0.5), {0.5, 0.5, 0.1}}}};
  const Camera camera = lookAt({0, -3, 1.5}, {0, 0, 0});
  const auto draw = [&](bool shadow) {
    return Renderer({.width = kWidth, .height = kHeight, .shadow = shadow}).draw(picture, camera);
  };
  EXPECT_LT(imageDifference(draw(true), draw(false), 2).largeShare, 1e-4);
}

std::vector<std::pair<Vector3d, Vector3d>> randomSegments(int count) {
  Rng rng(8);
  std::vector<std::pair<Vector3d, Vector3d>> segments;
  for (int i = 0; i < count; ++i) {
    const Vector3d from = rng.normalVector(3);
    segments.emplace_back(from, from + 0.3 * rng.normalVector(3));
  }
  segments.push_back({{0, 10, 0}, {0.2, -20, 0.3}});  // passes the camera
  segments.push_back({{0, 0, 1}, {0, 0, 1}});
  return segments;
}

TEST(LineSet, LooksLikeAPolylineForEachSegment) {
  REX_NEEDS_OSMESA();
  const Solid ball{{.type = ShapeType::kSphere, .radius = 0.7}, {}, {1, 1, 1}, "hides some"};
  Picture asSet{.solids = {ball}}, asLines{.solids = {ball}};
  asSet.lineSets.push_back({randomSegments(300), {1, 0, 0, 0.7f}, 3});
  for (const auto& [from, to] : randomSegments(300))
    asLines.polylines.push_back({{from, to}, {1, 0, 0, 0.7f}, 3});
  const Image image = drawn(asSet);
  EXPECT_LT(imageDifference(image, drawn(asLines), 2).largeShare, 1e-4);
  EXPECT_GT(redInColumn(image, kWidth / 2), 20);
}

TEST(LineSet, OfAnyNumberOrNoneIsDrawn) {
  REX_NEEDS_OSMESA();
  Picture picture{
      .solids = {{{.type = ShapeType::kSphere, .radius = 0.2}, translation(1.5, 0, 0), {}, "ball"}}};
  picture.lineSets.push_back({randomSegments(20000), kRed, 1});
  Renderer renderer({.width = kWidth, .height = kHeight});
  const Image many = renderer.draw(picture, fromSouth());
  picture.lineSets[0].segments.resize(10);
  const Image few = renderer.draw(picture, fromSouth());
  EXPECT_GT(redInColumn(many, kWidth / 2), redInColumn(few, kWidth / 2) + 50);
  picture.lineSets[0].segments.clear();
  EXPECT_NO_THROW(static_cast<void>(renderer.draw(picture, fromSouth())));
  EXPECT_EQ(redInColumn(renderer.draw(picture, fromSouth()), kWidth / 2), 0);
  // After a picture without any, the buffers of the first serve again.
  picture.lineSets[0].segments = randomSegments(20000);
  EXPECT_EQ(renderer.draw(picture, fromSouth()), many);
}

// Pixels that a label changes, left and right of the middle.
TEST(Labels, AtOnePointStandBesideEachOther) {
  REX_NEEDS_OSMESA();
  const Picture bare{.pointSets = {{.points = {{0, 0, 0}}}}};
  const auto changed = [&](const Picture& picture, int fromX, int toX) {
    const Image with = drawn(picture), without = drawn(bare);
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = fromX; x < toX; ++x) count += with.at(x, y) != without.at(x, y) ? 1 : 0;
    return count;
  };
  Picture picture = bare;
  picture.labels = {{"far away", {0, 0, 0}}};
  EXPECT_EQ(changed(picture, 0, kWidth / 2), 0);
  picture.labels.push_back({"near", {0, -1, 0}});
  const int near = changed({.pointSets = bare.pointSets, .labels = {picture.labels[1]}}, kWidth / 2, kWidth);
  EXPECT_EQ(changed(picture, kWidth / 2, kWidth), near) << "the nearer one keeps the first place";
  EXPECT_GT(changed(picture, 0, kWidth / 2), near);
}

}  // namespace rex::marks_test
