// Depth and segmentation images against closed forms, colour pictures, and each other.
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "render/renderer.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"

namespace rex::sensor_images_test {

using Eigen::Vector3d;
constexpr int kWidth = 160, kHeight = 120;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Color kRed{0.9f, 0.1f, 0.1f}, kGreen{0.1f, 0.8f, 0.1f}, kBlue{0.1f, 0.1f, 0.9f};
constexpr std::int32_t kNothing = SegmentationImage::kNothing, kGround = SegmentationImage::kGround;

Picture pictureOf(std::vector<Solid> solids) {
  Picture picture{.solids = std::move(solids)};
  picture.ground.visible = false;
  return picture;
}

Solid ball(const Vector3d& p, double radius, const Color& color = kRed) {
  return {{.type = ShapeType::kSphere, .radius = radius}, {.p = p}, color, "ball"};
}

Solid box(const Pose& X_WS, const Vector3d& size, const Color& color = kRed) {
  return {{ShapeType::kBox, size, 0}, X_WS, color, "box"};
}

Renderer smallRenderer() { return Renderer({.width = kWidth, .height = kHeight}); }

// From the camera through the middle of a pixel, as long as makes it 1 m deep.
Vector3d rayThrough(const Camera& camera, int x, int y) {
  const double focal = kHeight / (2 * std::tan(camera.verticalFov / 2));
  return camera.X_WC.R * Vector3d((x + 0.5 - kWidth / 2.0) / focal, (kHeight / 2.0 - y - 0.5) / focal, -1);
}

double depthOfBox(const Solid& solid, const Vector3d& eye, const Vector3d& ray) {
  const Pose X_SW = solid.X_WS.inverse();
  const Vector3d from = X_SW * eye, along = X_SW.R * ray, half = solid.shape.extent / 2;
  double enter = -kInfinity, leave = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const double a = (-half[i] - from[i]) / along[i], b = (half[i] - from[i]) / along[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave && enter > 0 ? enter : kInfinity;
}

double depthOfBall(const Solid& solid, const Vector3d& eye, const Vector3d& ray) {
  const Vector3d from = eye - solid.X_WS.p;
  const double a = ray.squaredNorm(), b = from.dot(ray);
  const double c = from.squaredNorm() - solid.shape.radius * solid.shape.radius;
  const double root = b * b - a * c;
  return root > 0 ? (-b - std::sqrt(root)) / a : kInfinity;
}

// Compares where both see something; outlines may differ by a pixel. Returns the number of compared pixels.
template <typename Expected>
int expectDepth(const DepthImage& depth, const Camera& camera, double tolerance, const Expected& expected) {
  int compared = 0, outline = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double wanted = expected(rayThrough(camera, x, y)), found = depth.at(x, y);
      if (std::isfinite(wanted) != std::isfinite(found)) {
        ++outline;
      } else if (std::isfinite(wanted)) {
        ++compared;
        EXPECT_NEAR(found, wanted, tolerance * wanted) << x << ' ' << y;
      }
    }
  EXPECT_LE(outline, 0.03 * compared + 2);
  return compared;
}

TEST(DepthImage, OfABoxIsWhereItsFacesAre) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  Rng rng(3);
  for (int i = 0; i < 5; ++i) {
    const Solid solid = box({expSO3(rng.normalVector(3)), 0.3 * rng.normalVector(3)}, {0.7, 0.9, 0.5});
    const Camera camera = lookAt({2, -3, 1.5}, {0, 0, 0});
    const DepthImage depth = renderer.drawDepth(pictureOf({solid}), camera);
    EXPECT_GT(expectDepth(depth, camera, 3e-4,
                          [&](const Vector3d& ray) { return depthOfBox(solid, camera.X_WC.p, ray); }),
              1000);
  }
}

// A mesh is off by a sixteenth of a pixel, both along its meridians and between them.
TEST(DepthImage, OfABallIsWhereItsSurfaceIs) {
  REX_NEEDS_OSMESA();
  for (const double away : {3.0, 6.0, 12.0}) {
    const Solid solid = ball({0.1, 0.1, 0.1}, 0.8);
    const Camera camera = lookAt({0.5, -away, 1}, {0, 0, 0});
    const DepthImage depth = smallRenderer().drawDepth(pictureOf({solid}), camera);
    const double pixel = 2 * std::tan(camera.verticalFov / 2) / kHeight;
    int compared = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Vector3d ray = rayThrough(camera, x, y);
        const double wanted = depthOfBall(solid, camera.X_WC.p, ray);
        const Vector3d normal = (camera.X_WC.p + wanted * ray - solid.X_WS.p) / solid.shape.radius;
        const double facing = -normal.dot(ray.normalized());
        if (!std::isfinite(wanted) || facing < 0.6) continue;  // the rim is too steep to compare
        ++compared;
        EXPECT_NEAR(depth.at(x, y), wanted, (1e-4 + pixel / 8 / facing) * wanted) << x << ' ' << y;
      }
    EXPECT_GT(compared, 150);
  }
}

TEST(DepthImage, OfTheGroundIsThatOfItsPlane) {
  REX_NEEDS_OSMESA();
  Picture picture;
  picture.ground.height = -0.2;
  picture.polylines = {{{{-3, 0, 0}, {3, 0, 0}}}};
  const double rim = 6 * bounds(picture).radius();
  for (const Vector3d& eye : {Vector3d(0, -3, 1), Vector3d(1, 1, 0.1), Vector3d(0, 0.1, 60)}) {
    Camera camera = lookAt(eye, {0, 0, 0});
    camera.nearPlane = 0.01;
    const DepthImage depth = smallRenderer().drawDepth(picture, camera);
    const auto expected = [&](const Vector3d& ray) {
      const double metres = (picture.ground.height - eye.z()) / ray.z();
      const Vector3d there = eye + metres * ray;
      const bool seen = metres > 0 && metres < camera.farPlane && there.head<2>().norm() < rim;
      return seen ? metres : kInfinity;
    };
    EXPECT_GT(expectDepth(depth, camera, 1e-3, expected), 5000);
  }
}

TEST(DepthImage, StartsAtTheNearAndEndsAtTheFarPlane) {
  REX_NEEDS_OSMESA();
  Camera camera = lookAt({0, -3, 0}, {0, 0, 0});
  camera.nearPlane = 2.5, camera.farPlane = 3.5;
  const DepthImage depth = smallRenderer().drawDepth(
      pictureOf({box(translation(0, 0, -0.3), {0.2, 20, 0.2}), ball({0, 1, 0}, 0.4)}), camera);
  int seen = 0;
  for (const double metres : depth.metres) {
    if (!std::isfinite(metres)) continue;
    ++seen;
    EXPECT_GE(metres, 2.499);
    EXPECT_LE(metres, 3.501);
  }
  EXPECT_GT(seen, 0);
}

bool shows(const Image& image, int x, int y, int c) {
  const auto rgb = image.at(x, y);
  return rgb[c] > rgb[(c + 1) % 3] + 50 && rgb[c] > rgb[(c + 2) % 3] + 50;
}

TEST(SegmentationImage, AgreesWithTheColoursOfThePicture) {
  REX_NEEDS_OSMESA();
  Renderer renderer(
      {.width = kWidth, .height = kHeight, .antiAliasing = AntiAliasing::kNone, .shadow = false});
  const Picture picture = pictureOf({box(rotation(0.4, {1, 1, 0}), {0.5, 0.5, 0.9}, kRed),
                                     ball({0.3, -0.2, 0.3}, 0.3, kGreen),
                                     {{ShapeType::kCapsule, {0, 0, 1}, 0.15},
                                      translation(-0.4, 0.2, 0) * rotation(1, {0, 1, 0}),
                                      kBlue,
                                      "capsule"}});
  const Camera camera = lookAt({1, -4, 1}, {0, 0, 0});
  const Image image = renderer.draw(picture, camera);
  const SegmentationImage ids = renderer.drawSegmentation(picture, camera);
  int inside = 0, outline = 0;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x) {
      int shown = kNothing;
      for (int c = 0; c < 3; ++c)
        if (shows(image, x, y, c)) shown = c;
      inside += shown >= 0 ? 1 : 0;
      if (ids.at(x, y) == shown) continue;
      ++outline;
      int around = 0;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        around += ids.at(x + dx, y + dy) == shown ? 1 : 0;
      EXPECT_GT(around, 0) << x << ' ' << y << ": more than an outline that moves by a pixel";
    }
  EXPECT_GT(inside, 1500);
  EXPECT_LT(outline, 0.03 * inside);
  const std::set<std::int32_t> all(ids.id.begin(), ids.id.end());
  EXPECT_EQ(all, (std::set<std::int32_t>{kNothing, 0, 1, 2}));
}

Picture heap() {
  Rng rng(8);
  Picture picture;
  for (int i = 0; i < 12; ++i) {
    const Pose X_WS{expSO3(rng.normalVector(3)), 0.4 * rng.normalVector(3) + Vector3d(0, 0, 0.6)};
    picture.solids.push_back(i % 2 == 0 ? box(X_WS, {0.4, 0.5, 0.3}) : ball(X_WS.p, 0.25));
  }
  return picture;
}

// Each solid alone is its own second opinion: in front is the one with the least depth.
TEST(SegmentationImage, NamesTheNearestSolid) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const Picture picture = heap();
  const Camera camera = lookAt({2, -4, 2}, {0, 0, 0.5});
  const DepthImage depth = renderer.drawDepth(picture, camera);
  const SegmentationImage ids = renderer.drawSegmentation(picture, camera);
  std::vector<DepthImage> alone;
  for (const Solid& solid : picture.solids) alone.push_back(renderer.drawDepth(pictureOf({solid}), camera));
  int solids = 0, ground = 0;
  for (std::size_t i = 0; i < ids.id.size(); ++i) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const DepthImage& one : alone) nearest = std::min(nearest, one.metres[i]);
    EXPECT_LE(depth.metres[i], nearest);
    if (ids.id[i] >= 0) {
      ++solids;
      EXPECT_EQ(depth.metres[i], nearest);
      EXPECT_NEAR(alone[static_cast<std::size_t>(ids.id[i])].metres[i], nearest, 1e-5);
    }
    ground += ids.id[i] == kGround ? 1 : 0;
    EXPECT_EQ(ids.id[i] == kNothing, std::isinf(depth.metres[i]));
  }
  EXPECT_GT(solids, 2000);
  EXPECT_GT(ground, 2000);
}

// What one camera sees at a place of space, another sees there too, or something nearer.
TEST(DepthImage, AgreesBetweenTwoCameras) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const Picture picture = heap();
  const Camera one = lookAt({2, -4, 2}, {0, 0, 0.5}), other = lookAt({3, -3, 2.5}, {0, 0, 0.5});
  const DepthImage fromOne = renderer.drawDepth(picture, one), fromOther = renderer.drawDepth(picture, other);
  int same = 0, hidden = 0, through = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!std::isfinite(fromOne.at(x, y))) continue;
      const Vector3d there = one.X_WC.p + fromOne.at(x, y) * rayThrough(one, x, y);
      const auto at = project(other, there, kWidth, kHeight);
      if (!at || at->x < 0 || at->y < 0 || at->x >= kWidth || at->y >= kHeight) continue;
      const double gap = fromOther.at(static_cast<int>(at->x), static_cast<int>(at->y)) - at->depth;
      (std::abs(gap) < 0.03 * at->depth ? same : gap < 0 ? hidden : through) += 1;
    }
  EXPECT_GT(same, 8000);
  EXPECT_GT(hidden, 100);
  EXPECT_LT(through, 0.02 * same) << "outlines, where a pixel is farther";
}

TEST(SensorImages, CountSolidsOnly) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  Color glass = kRed;
  glass.a = 0.3f;
  Picture picture = pictureOf({ball({0, 2, 0}, 0.2), ball({0, 0, 0}, 0.5, glass)});
  const SegmentationImage ids = renderer.drawSegmentation(picture, camera);
  EXPECT_EQ(ids.at(kWidth / 2, kHeight / 2), 1) << "glass hides what is behind it from a sensor";
  EXPECT_EQ(std::count(ids.id.begin(), ids.id.end(), 0), 0) << "hidden";
  const DepthImage depth = renderer.drawDepth(picture, camera);
  picture.polylines = {{{{-1, -1, 0}, {1, -1, 0}}}};
  picture.pointSets = {{.points = {{0, -1, 0}}}};
  picture.axes = {{translation(0, -1, 0), 1, "A"}};
  picture.arrows = {{.from = {0, -1, 0}, .to = {0, -1, 1}}};
  picture.ellipsoids = {{.X_WE = translation(0, -1, 0)}};
  picture.labels = {{"label", {0, 0, 0}}};
  EXPECT_EQ(renderer.drawDepth(picture, camera), depth);
  EXPECT_EQ(renderer.drawSegmentation(picture, camera), ids);
}

TEST(SensorImages, MayShowNothing) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  const auto allEqual = [](const auto& values, auto wanted) {
    return !values.empty() && std::all_of(values.begin(), values.end(), [&](auto v) { return v == wanted; });
  };
  const Camera camera = lookAt({0, -6, 1}, {0, 0, 1}), below = lookAt({0, -6, -1}, {0, 0, 1});
  EXPECT_TRUE(allEqual(renderer.drawDepth(pictureOf({}), camera).metres, kInfinity));
  EXPECT_TRUE(allEqual(renderer.drawSegmentation(pictureOf({}), camera).id, kNothing));
  EXPECT_TRUE(allEqual(renderer.drawSegmentation({}, below).id, kNothing)) << "no ground from below";
  EXPECT_FALSE(allEqual(renderer.drawSegmentation({}, camera).id, kNothing));
}

// Nothing of one kind of image stays behind in OpenGL for the next.
TEST(SensorImages, DoNotDisturbPicturesInAnyAntiAliasing) {
  REX_NEEDS_OSMESA();
  Picture picture = heap();
  picture.polylines = {{{{-1, -1, 0}, {1, -1, 1}}}};
  const Camera camera = lookAt({2, -4, 2}, {0, 0, 0.5});
  const DepthImage depth = smallRenderer().drawDepth(picture, camera);
  for (const AntiAliasing smooth : {AntiAliasing::kNone, AntiAliasing::kFxaa, AntiAliasing::kMsaa4}) {
    Renderer renderer({.width = kWidth, .height = kHeight, .antiAliasing = smooth});
    const Image before = renderer.draw(picture, camera);
    EXPECT_EQ(renderer.drawDepth(picture, camera), depth);
    EXPECT_EQ(renderer.draw(picture, camera), before);
    EXPECT_EQ(renderer.drawDepth(picture, camera), depth);
  }
}

TEST(SensorImages, RejectWhatCannotBeDrawn) {
  REX_NEEDS_OSMESA();
  Renderer renderer = smallRenderer();
  Camera camera = lookAt({0, -6, 1}, {0, 0, 1});
  const Picture bad = pictureOf({ball({std::nan(""), 0, 0}, 1)});
  EXPECT_REX_ERROR(renderer.drawDepth(bad, camera), "solid 'ball'");
  EXPECT_REX_ERROR(renderer.drawSegmentation(bad, camera), "solid 'ball'");
  camera.X_WC.p.x() = std::nan("");
  EXPECT_REX_ERROR(renderer.drawDepth({}, camera), "camera: found a pose that is not finite");
  EXPECT_REX_ERROR(renderer.drawSegmentation({}, camera), "camera: found a pose that is not finite");
}

double brightness(const std::array<int, 3>& rgb) { return 0.3 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2]; }

// Evenly over 1 / depth, from 1 m to 3 m.
TEST(DepthColors, GrowDarkerWithDepth) {
  DepthImage depth{.width = 101, .height = 1};
  for (int i = 0; i <= 100; ++i) depth.metres.push_back(3 / (3 - 0.02f * static_cast<float>(i)));
  const Image image = depthColors(depth, 1, 3);
  for (int x = 1; x <= 100; ++x) {
    const double darker = brightness(image.at(x - 1, 0)) - brightness(image.at(x, 0));
    EXPECT_GT(darker, 0.5) << x;
    EXPECT_LT(darker, 4) << x;
  }
  EXPECT_EQ(depthColors(depth), image) << "its own range";
  depth.metres = {0.5f, 4};
  depth.width = 2;
  EXPECT_EQ(depthColors(depth, 1, 3).at(0, 0), image.at(0, 0)) << "no colours beyond the ends";
  EXPECT_EQ(depthColors(depth, 1, 3).at(1, 0), image.at(100, 0));
}

TEST(DepthColors, TellNothingFromAnyDepth) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const Image image = depthColors({.width = 3, .height = 1, .metres = {kFar, 2, 2}});
  const auto nothing = image.at(0, 0);
  EXPECT_GT(*std::min_element(nothing.begin(), nothing.end()), 220);
  EXPECT_EQ(image.at(1, 0), image.at(2, 0));
  EXPECT_LT(image.at(1, 0)[2], 200);
  EXPECT_EQ(depthColors({.width = 1, .height = 1, .metres = {kFar}}).at(0, 0), nothing);
}

TEST(DepthColors, RejectStrangeRanges) {
  const DepthImage depth{.width = 1, .height = 1, .metres = {1}};
  EXPECT_REX_ERROR(depthColors(depth, 2, 1), "depth colours: found from 2 m to 1 m, wanted 0 < nearest");
  EXPECT_REX_ERROR(depthColors(depth, 1, kInfinity), "from 1 m to inf m");
  EXPECT_REX_ERROR(depthColors(depth, 0, 1), "from 0 m to 1 m");
  EXPECT_REX_ERROR(depthColors(depth, std::nan(""), 1), "from nan m");
  EXPECT_REX_ERROR(depthColors(DepthImage{}), "image size: found 0 x 0");
}

TEST(SegmentationColors, TellIdsApartAndKeepThem) {
  constexpr int kIds = 24;
  SegmentationImage ids{.width = kIds + 2, .height = 1};
  ids.id.resize(kIds + 2);
  std::iota(ids.id.begin(), ids.id.end(), kGround);
  const Image image = segmentationColors(ids);
  for (int a = 0; a < image.width; ++a)
    for (int b = 0; b < a; ++b) {
      int apart = 0;
      for (std::size_t c = 0; c < 3; ++c) apart += std::abs(image.at(a, 0)[c] - image.at(b, 0)[c]);
      EXPECT_GT(apart, 40) << a - 2 << ' ' << b - 2;
    }
  const Image alone = segmentationColors({.width = 1, .height = 1, .id = {7}});
  EXPECT_EQ(alone.at(0, 0), image.at(9, 0));
  EXPECT_REX_ERROR(segmentationColors({}), "image size: found 0 x 0");
}

}  // namespace rex::sensor_images_test
