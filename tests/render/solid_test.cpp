// Solids: the right pixels, in the right order, lit and shadowed as they should be.
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "geometry/welded_mesh.h"
#include "render/renderer.h"
#include "support/draw_once.h"
#include "support/expect_error.h"
#include "support/image_difference.h"
#include "support/mesh_samples.h"
#include "support/needs_osmesa.h"

namespace rex::solid_test {

using Eigen::Vector3d;

constexpr Color kRed{0.9f, 0.1f, 0.1f}, kGreen{0.1f, 0.8f, 0.1f}, kBlue{0.1f, 0.1f, 0.9f};

Picture pictureOf(std::vector<Solid> solids) {
  Picture picture{.solids = std::move(solids)};
  picture.ground.visible = false;
  return picture;
}

Solid ball(const Vector3d& p, double radius, const Color& color) {
  return {{.type = ShapeType::kSphere, .radius = radius}, {.p = p}, color, "ball"};
}

// Channel `c` stands out against both others.
bool shows(const Image& image, int x, int y, int c) {
  const auto rgb = image.at(x, y);
  return rgb[c] > rgb[(c + 1) % 3] + 60 && rgb[c] > rgb[(c + 2) % 3] + 60;
}

struct Blob {
  int count = 0;
  double x = 0, y = 0;  // pixels, middle of all
};

Blob blobOf(const Image& image, int channel) {
  Blob blob;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (shows(image, x, y, channel)) ++blob.count, blob.x += x + 0.5, blob.y += y + 0.5;
  blob.x /= blob.count, blob.y /= blob.count;
  return blob;
}

// Signed distance from a point in the shape's own frame to its surface: a second opinion on what a solid is.
double distanceTo(const Shape& shape, const Vector3d& p) {
  const Vector3d half = shape.extent / 2;
  const auto boxDistance = [](const auto& q) { return q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff()); };
  if (shape.type == ShapeType::kSphere) return p.norm() - shape.radius;
  if (shape.type == ShapeType::kCapsule)
    return (p - Vector3d(0, 0, std::clamp(p.z(), -half.z(), half.z()))).norm() - shape.radius;
  if (shape.type == ShapeType::kCylinder)
    return boxDistance(Eigen::Vector2d(p.head<2>().norm() - shape.radius, std::abs(p.z()) - half.z()));
  if (shape.type == ShapeType::kCone) {  // to the planes beside it; beyond its edges it is farther away
    const double rho = p.head<2>().norm(), slant = std::hypot(shape.radius, 2 * half.z());
    const double side = (2 * half.z() * rho + shape.radius * (p.z() - half.z())) / slant;
    return std::max(side, -half.z() - p.z());
  }
  if (shape.type == ShapeType::kEllipsoid)  // near the surface: the level set over its gradient
    return (p.cwiseQuotient(half).squaredNorm() - 1) / (2 * p.cwiseQuotient(half.cwiseAbs2()).norm());
  return boxDistance(Vector3d(p.cwiseAbs() - half + Vector3d::Constant(shape.radius))) - shape.radius;
}

bool rayHits(const Solid& solid, const Camera& camera, double x, double y, int width, int height) {
  const double focal = height / (2 * std::tan(camera.verticalFov / 2));
  const Vector3d along_C((x - width / 2.0) / focal, (height / 2.0 - y) / focal, -1);
  const Pose X_SW = solid.X_WS.inverse();
  const Vector3d from = X_SW * camera.X_WC.p;
  const Vector3d along = X_SW.R * (camera.X_WC.R * along_C.normalized());
  double travelled = 0;
  for (int i = 0; i < 200 && travelled < 20; ++i) {
    const double gap = distanceTo(solid.shape, from + travelled * along);
    if (gap < 1e-4) return true;
    travelled += gap;
  }
  return false;
}

// Whether the outline passes within `reach` pixels of that point of the picture.
bool isNearOutline(const Solid& solid, const Camera& camera, double x, double y, int width, int height,
                   double reach) {
  int hits = 0;
  constexpr int kAround = 8;
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2 * std::numbers::pi * k / kAround;
    hits += rayHits(solid, camera, x + reach * std::cos(angle), y + reach * std::sin(angle), width, height);
  }
  return hits > 0 && hits < kAround;
}

class SolidOutline : public testing::TestWithParam<Shape> {};

TEST_P(SolidOutline, IsThatOfARayCaster) {
  REX_NEEDS_OSMESA();
  constexpr int kWidth = 161, kHeight = 120;
  Renderer renderer({.width = kWidth, .height = kHeight, .antiAliasing = AntiAliasing::kNone});
  Rng rng(5);
  for (int i = 0; i < 6; ++i) {
    const Solid solid{GetParam(), {expSO3(rng.normalVector(3)), 0.3 * rng.normalVector(3)}, kRed, "it"};
    const Camera camera = lookAt({2, -3, 1.5}, {0.2, 0.1, 0});
    const Image image = renderer.draw(pictureOf({solid}), camera);
    int inside = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool hit = rayHits(solid, camera, x + 0.5, y + 0.5, kWidth, kHeight);
        inside += hit;
        if (hit == shows(image, x, y, 0)) continue;
        // A mesh with flat sides may miss the middle of a pixel on the edge, by less than half a pixel.
        EXPECT_TRUE(isNearOutline(solid, camera, x + 0.5, y + 0.5, kWidth, kHeight, 0.5))
            << "pixel " << x << ", " << y;
      }
    ASSERT_GT(inside, 300);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidOutline,
                         testing::Values(Shape{ShapeType::kBox, {0.6, 0.9, 0.3}, 0},
                                         Shape{ShapeType::kRoundedBox, {0.5, 0.4, 0.8}, 0.15},
                                         Shape{.type = ShapeType::kSphere, .radius = 0.4},
                                         Shape{ShapeType::kCapsule, {0, 0, 0.8}, 0.25},
                                         Shape{ShapeType::kCylinder, {0, 0, 0.7}, 0.35},
                                         Shape{ShapeType::kCone, {0, 0, 0.8}, 0.4},
                                         Shape{ShapeType::kEllipsoid, {0.5, 0.9, 0.7}}),
                         [](const auto& shape) {
                           return shape.param.type == ShapeType::kRoundedBox
                                      ? "roundedBox"
                                      : std::string(toString(shape.param.type));
                         });

TEST(Solids, ArePutWhereTheCameraSeesThem) {
  REX_NEEDS_OSMESA();
  Renderer renderer({.width = 320, .height = 240});
  // From the south: east is right, up is up. Nothing is mirrored or upside down.
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  const Image image = renderer.draw(
      pictureOf({ball({1, 0, 0}, 0.2, kRed), ball({0, 0, 1}, 0.2, kGreen), ball({-1, 0, -1}, 0.2, kBlue)}),
      camera);
  const Blob red = blobOf(image, 0), green = blobOf(image, 1), blue = blobOf(image, 2);
  EXPECT_GT(red.x, 200);
  EXPECT_LT(green.y, 90);
  EXPECT_LT(blue.x, 120);
  EXPECT_GT(blue.y, 150);
  const auto at = project(camera, {1, 0, 0}, 320, 240);
  EXPECT_NEAR(red.x, at->x, 1.0);
  EXPECT_NEAR(red.y, at->y, 1.0);
  const double radius = 240 / (2 * std::tan(camera.verticalFov / 2)) * 0.2 / 6;
  EXPECT_NEAR(red.count, std::numbers::pi * radius * radius, 0.08 * red.count);
}

TEST(Solids, HideWhatIsBehindThemInAnyOrder) {
  REX_NEEDS_OSMESA();
  Renderer renderer({.width = 80, .height = 60});
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  const Solid front = ball({0, -1, 0}, 0.3, kRed), behind = ball({0, 1, 0}, 0.9, kBlue);
  const Image one = renderer.draw(pictureOf({front, behind}), camera);
  const Image other = renderer.draw(pictureOf({behind, front}), camera);
  EXPECT_TRUE(shows(one, 40, 30, 0));
  EXPECT_TRUE(shows(one, 40, 22, 2));
  EXPECT_LT(imageDifference(one, other, 1).largeShare, 1e-9);
}

TEST(Solids, LetTheSceneThroughWhenTranslucentInAnyOrder) {
  REX_NEEDS_OSMESA();
  Renderer renderer({.width = 80, .height = 60});
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  Color glass = kRed;
  glass.a = 0.5f;
  const Solid front = ball({0, -1, 0}, 0.5, glass), middle = ball({0, 0.5, 0}, 0.7, {0, 1, 0, 0.5f});
  const Solid behind = ball({0, 2, 0}, 0.6, kBlue);
  const Image image = renderer.draw(pictureOf({front, middle, behind}), camera);
  EXPECT_EQ(image, renderer.draw(pictureOf({behind, middle, front}), camera));
  const auto rgb = image.at(40, 30);
  EXPECT_GT(rgb[0], rgb[1] + 20) << "the nearest dominates";
  EXPECT_GT(rgb[1], rgb[2]);
  EXPECT_GT(rgb[2], 20);
}

TEST(AntiAliasing, SmoothsEdgesAndNothingElse) {
  REX_NEEDS_OSMESA();
  Solid box{{ShapeType::kBox, {0.8, 0.8, 0.8}, 0}, rotation(0.1, {0, 1, 0}), kRed, "box"};
  const Camera camera = lookAt({0, -6, 0}, {0, 0, 0});
  const auto drawn = [&](AntiAliasing antiAliasing) {
    return Renderer({.width = 160, .height = 120, .antiAliasing = antiAliasing, .shadow = false})
        .draw(pictureOf({box}), camera);
  };
  const auto mixedPixels = [](const Image& image) {
    int mixed = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        mixed += image.at(x, y)[1] > 100 && image.at(x, y)[1] < 225 ? 1 : 0;
    return mixed;
  };
  const Image rough = drawn(AntiAliasing::kNone), smooth = drawn(AntiAliasing::kMsaa4);
  EXPECT_EQ(mixedPixels(rough), 0);
  EXPECT_GT(mixedPixels(smooth), 30);
  EXPECT_LT(imageDifference(rough, smooth, 2).largeShare, 0.02);
}

// A box floats over the ground. Where a ray towards the light meets it, the ground is darker; elsewhere not.
TEST(Shadow, FallsWhereTheLightIsHidden) {
  REX_NEEDS_OSMESA();
  Picture picture{.solids = {{{ShapeType::kBox, {0.5, 0.4, 0.1}, 0}, translation(0, 0, 0.6), kRed, "box"}}};
  picture.toLight = {0.5, 0.3, 1};
  const Camera camera = lookAt({0, -3, 3}, {-0.2, 0, 0});
  constexpr int kWidth = 320, kHeight = 240;
  Renderer with({.width = kWidth, .height = kHeight}),
      without({.width = kWidth, .height = kHeight, .shadow = false});
  const Image shadowed = with.draw(picture, camera), lit = without.draw(picture, camera);
  int inShadow = 0, inLight = 0;
  for (double x = -1.5; x <= 1.5; x += 0.05) {
    for (double y = -1; y <= 1.5; y += 0.05) {
      const Vector3d ground(x, y, 0);
      const Vector3d above = ground + picture.toLight * 0.6;
      const double outside = std::max(std::abs(above.x()) - 0.25, std::abs(above.y()) - 0.2);
      const auto at = project(camera, ground, kWidth, kHeight);
      const int px = static_cast<int>(at->x), py = static_cast<int>(at->y);
      const bool seen = px >= 0 && py >= 0 && px < kWidth && py < kHeight && !shows(lit, px, py, 0);
      if (!seen || std::abs(outside) < 0.08) continue;
      const int darker = lit.at(px, py)[1] - shadowed.at(px, py)[1];
      if (outside < 0) {
        ++inShadow;
        EXPECT_GT(darker, 25) << x << ' ' << y;
      } else {
        ++inLight;
        EXPECT_LE(std::abs(darker), 1) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(inShadow, 10);
  EXPECT_GT(inLight, 500);
}

// No shadow acne: a convex solid that stands alone looks as it does without shadows, also when others far
// away make the pixels of the shadow map large.
TEST(Shadow, LeavesALonelySolidAlone) {
  REX_NEEDS_OSMESA();
  Rng rng(4);
  const Camera camera = lookAt({2, -3, 1.5}, {0, 0, 0});
  Renderer with({.width = 320, .height = 240}), without({.width = 320, .height = 240, .shadow = false});
  for (const double toOthers : {0.0, 6.0, 25.0}) {
    for (const Shape& shape :
         {Shape{ShapeType::kBox, {0.9, 0.9, 0.9}, 0}, Shape{.type = ShapeType::kSphere, .radius = 0.6},
          Shape{ShapeType::kCapsule, {0, 0, 1}, 0.3}, Shape{ShapeType::kCylinder, {0, 0, 0.8}, 0.5}}) {
      for (int i = 0; i < 4; ++i) {
        const Picture picture = pictureOf({{shape, {expSO3(rng.normalVector(3)), {0, 0, 0}}, kRed, "it"},
                                           ball({toOthers, toOthers, 0}, 0.05, kRed),
                                           ball({-toOthers, 0, 0}, 0.05, kRed)});
        const ImageDifference apart =
            imageDifference(with.draw(picture, camera), without.draw(picture, camera), 12);
        EXPECT_LT(apart.largeShare, 2e-4) << toString(shape.type) << ' ' << toOthers;
      }
    }
  }
}

TEST(Ground, IsSeenFromAboveOnlyAndFadesOut) {
  REX_NEEDS_OSMESA();
  Picture picture{.solids = {ball({0, 0, 0.5}, 0.2, kRed)}};
  picture.ground.dark = {0, 0, 0};
  Renderer renderer({.width = 160, .height = 120});
  const auto darkPixels = [&](const Vector3d& eye) {
    const Image image = renderer.draw(picture, lookAt(eye, {0, 0, 0.4}));
    int dark = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) dark += image.at(x, y)[0] < 60 ? 1 : 0;
    return dark;
  };
  EXPECT_GT(darkPixels({0, -2, 2}), 1000);
  EXPECT_EQ(darkPixels({0, -2, -1}), 0);
  EXPECT_LT(darkPixels({0, -60, 60}), 300);
}

TEST(Renderer, GivesTheSameBytesEveryTime) {
  REX_NEEDS_OSMESA();
  Rng rng(9);
  Picture picture;
  for (int i = 0; i < 20; ++i)
    picture.solids.push_back({{i % 2 == 0 ? ShapeType::kCapsule : ShapeType::kBox, {0.2, 0.3, 0.4}, 0.1},
                              {expSO3(rng.normalVector(3)), rng.normalVector(3)},
                              kGreen,
                              ""});
  Renderer one({.width = 200, .height = 150}), other({.width = 200, .height = 150});
  const Camera camera = framing(bounds(picture), kDefaultView, 4. / 3);
  const Image first = one.draw(picture, camera);
  EXPECT_EQ(first, one.draw(picture, camera));
  EXPECT_EQ(first, other.draw(picture, camera));
  Renderer moved = std::move(other);
  EXPECT_EQ(first, moved.draw(picture, camera));
}

// A renderer keeps the shadows of what has not moved.
TEST(Renderer, DrawsAfterAnyPictureWhatAFreshOneDraws) {
  REX_NEEDS_OSMESA();
  const RendererOptions small{.width = 80, .height = 60};
  const BareMesh cube = cubeSample(0.2f), ball = sphereSample(0.2f, 2);
  const auto meshOf = [](const BareMesh& bare) {
    return Shape{.type = ShapeType::kMesh, .mesh = weldedMesh(bare.positions, bare.triangles)};
  };
  Picture first{.solids = {{meshOf(cube), translation(0, 0, 0.8), {0.9f, 0.3f, 0.1f}, "mesh"},
                           {{ShapeType::kBox, {1, 1, 0.2}, 0}, translation(0, 0, 0.1), {}, "table"}}};
  Picture moved = first, lit = first, other = first, faint = first, grown = first, fewer = first;
  moved.solids[0].X_WS.p.x() += 0.1;
  lit.toLight = {1, 0, 1.5};
  other.solids[0].shape = meshOf(ball);
  faint.solids[0].color.a = 0.5f;
  grown.solids[1].shape.extent.x() += 0.1;
  fewer.solids.erase(fewer.solids.begin());
  const Camera near = lookAt({1, -3, 2}, {0, 0, 0.4}), far = lookAt({-3, -9, 4}, {0, 0, 0.4});
  Renderer renderer(small);
  for (const Picture* picture : {&first, &first, &moved, &first, &lit, &first, &other, &first, &faint, &first,
                                 &grown, &first, &fewer, &first})
    for (const Camera& camera : {near, far})
      EXPECT_EQ(renderer.draw(*picture, camera), Renderer(small).draw(*picture, camera));
}

TEST(Renderer, DrawsAnySize) {
  REX_NEEDS_OSMESA();
  const Picture picture = pictureOf({{{ShapeType::kBox, {1, 1, 1}, 0}, {}, kRed, "box"}});
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {33, 7}, {301, 201}}) {
    const Image image = drawOnce(picture, {.width = width, .height = height});
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    const auto middle = image.at(width / 2, height / 2);
    EXPECT_GT(middle[0], middle[1] + 20) << width << ' ' << height;
  }
}

TEST(Renderer, SaysWhatItUses) {
  REX_NEEDS_OSMESA();
  const Renderer renderer({.width = 8, .height = 8});
  EXPECT_THAT(renderer.describe(), testing::AnyOf(testing::HasSubstr("EGL (libEGL.so."),
                                                  testing::HasSubstr("OSMesa (libOSMesa.so.")));
  EXPECT_THAT(renderer.describe(), testing::HasSubstr("4 samples per pixel"));
  const Renderer plain({.width = 8, .height = 8, .antiAliasing = AntiAliasing::kNone});
  EXPECT_THAT(plain.describe(), testing::EndsWith("no anti-aliasing"));
  EXPECT_EQ(plain.options().width, 8);
}

TEST(Renderer, RefusesPicturesWithoutTheScene) {
  REX_NEEDS_OSMESA();
  Renderer renderer({.width = 64, .height = 48});
  const Camera away = lookAt({0, -3, 0.5}, {0, -6, 0}), here = lookAt({0, -3, 0.5}, {0, 0, 0});
  const char* message =
      "the picture shows nothing of the scene: found all solids, lines and points outside it";
  const std::vector<std::function<void(Picture&)>> things = {
      [](Picture& p) {
        p.solids.push_back(ball({0, 0, 0.5}, 0.3, kRed));
      },
      [](Picture& p) {
        p.solids.push_back(ball({0, 0, 0.5}, 0.3, {0, 1, 0, 0.5f}));
      },
      [](Picture& p) {
        p.solids.push_back({{ShapeType::kMarker, {1, 1, 1}, 0}, {}, {}, "marker"});
      },
      [](Picture& p) {
        p.polylines.push_back({{{0, 0, 0}, {1, 0, 1}}});
      },
      [](Picture& p) {
        p.pointSets.push_back({{{0, 0, 0}}});
      },
      [](Picture& p) { p.axes.push_back({}); }};
  for (std::size_t i = 0; i < things.size(); ++i) {
    for (const bool ground : {true, false}) {
      Picture picture{.captions = {{"a title hides nothing"}}};
      picture.ground.visible = ground;
      things[i](picture);
      EXPECT_REX_ERROR(renderer.draw(picture, away), message);
      EXPECT_NO_THROW(static_cast<void>(renderer.draw(picture, here))) << i;
    }
  }
}

TEST(Renderer, RefusesABlankPicture) {
  REX_NEEDS_OSMESA();
  Renderer renderer({.width = 64, .height = 48});
  const Camera down = lookAt({0, -3, 1}, {0, 0, 0}), up = lookAt({0, 0, 1}, {0, 0, 2});
  EXPECT_REX_ERROR(renderer.draw(pictureOf({}), down),
                   "the picture is blank: found nothing that stands out from the background");
  EXPECT_REX_ERROR(renderer.draw(Picture{}, up), "the picture is blank");
  EXPECT_NO_THROW(static_cast<void>(renderer.draw(Picture{}, down))) << "ground alone is something";
  Picture text = pictureOf({});
  text.labels = {{"out of sight", {0, 0, -9}}};
  EXPECT_REX_ERROR(renderer.draw(text, up), "the picture is blank");
  text.captions = {{"a title"}};
  EXPECT_NO_THROW(static_cast<void>(renderer.draw(text, up)));
}

TEST(Renderer, RejectsSizesAndCameras) {
  REX_NEEDS_OSMESA();
  EXPECT_REX_ERROR(Renderer({.width = 0}), "picture size: found 0 x 480, wanted 1 to 8192 pixels each way");
  EXPECT_REX_ERROR(Renderer({.height = 8193}), "found 640 x 8193");
  Renderer renderer({.width = 16, .height = 16});
  const Picture picture = pictureOf({ball({0, 0, 0}, 0.5, kRed)});
  Camera camera = lookAt({0, -3, 0}, {0, 0, 0});
  camera.nearPlane = 0;
  EXPECT_REX_ERROR(renderer.draw(picture, camera),
                   "camera: found near 0 m, far 100 m, wanted 0 < near < far");
  camera = lookAt({0, -3, 0}, {0, 0, 0});
  camera.verticalFov = 3.2;
  EXPECT_REX_ERROR(renderer.draw(picture, camera), "camera: found a vertical field of view of 3.2 rad");
  camera.X_WC.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(renderer.draw(picture, camera), "camera: found a pose that is not finite");
}

}  // namespace rex::solid_test
