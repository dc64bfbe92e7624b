// Edges without steps: FXAA against no anti-aliasing, samples, and the truth of a far larger picture.
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "render/renderer.h"
#include "support/needs_osmesa.h"

namespace rex::anti_aliasing_test {

constexpr int kWidth = 160, kHeight = 120;
constexpr Color kRed{0.9f, 0.1f, 0.1f}, kWhite{1, 1, 1};

// A slanted box, a thin rod and a ball before white.
Picture slanted() {
  Picture picture{
      .solids = {{{ShapeType::kBox, {0.8, 0.8, 0.8}, 0}, rotation(0.1, {0, 1, 0}), kRed, "box"},
                 {{ShapeType::kCapsule, {0, 0, 2}, 0.03},
                  translation(0.4, 0, 0.65) * rotation(1.45, {0, 1, 0}),
                  kRed,
                  "rod"},
                 {{.type = ShapeType::kSphere, .radius = 0.3}, translation(1, 0, 0), kRed, "ball"}}};
  picture.ground.visible = false;
  return picture;
}

Image drawn(AntiAliasing antiAliasing, int scale = 1, const Picture& picture = slanted()) {
  Renderer renderer({.width = scale * kWidth,
                     .height = scale * kHeight,
                     .antiAliasing = antiAliasing,
                     .shadow = false,
                     .backgroundTop = kWhite,
                     .backgroundBottom = kWhite});
  return renderer.draw(picture, lookAt({0, -6, 0}, {0, 0, 0}));
}

// The average of scale x scale pixels each.
Image reduced(const Image& image, int scale) {
  Image result(image.width / scale, image.height / scale);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < scale * scale; ++i)
          sum += image.pixel(scale * x + i % scale, scale * y + i / scale)[c];
        result.pixel(x, y)[c] = static_cast<std::uint8_t>(sum / (scale * scale));
      }
  return result;
}

double meanSquare(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::pow(a.rgb[i] - b.rgb[i], 2);
  return sum / static_cast<double>(a.rgb.size());
}

// Pixels that leap from the box to the background or back, seen from the left and from above.
int steps(const Image& image) {
  const auto leaps = [&](int x, int y, int toX, int toY) {
    return std::abs(image.at(x, y)[1] - image.at(toX, toY)[1]) > 180;
  };
  int count = 0;
  for (int y = 1; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) count += leaps(x, y, x - 1, y) || leaps(x, y, x, y - 1) ? 1 : 0;
  return count;
}

TEST(Fxaa, RemovesMostStepsOfSlantedEdges) {
  REX_NEEDS_OSMESA();
  const int rough = steps(drawn(AntiAliasing::kNone)), smooth = steps(drawn(AntiAliasing::kFxaa));
  ASSERT_GT(rough, 200);
  EXPECT_LT(smooth, 0.4 * rough);
}

TEST(Fxaa, ComesNearToTheTruth) {
  REX_NEEDS_OSMESA();
  const Image truth = reduced(drawn(AntiAliasing::kNone, 8), 8);
  const double rough = meanSquare(drawn(AntiAliasing::kNone), truth);
  EXPECT_LT(meanSquare(drawn(AntiAliasing::kFxaa), truth), 0.4 * rough);
  EXPECT_LT(meanSquare(drawn(AntiAliasing::kMsaa4), truth), 0.2 * rough);
}

TEST(Fxaa, LeavesFlatRegionsAlone) {
  REX_NEEDS_OSMESA();
  const Image rough = drawn(AntiAliasing::kNone), smooth = drawn(AntiAliasing::kFxaa);
  int flat = 0, changed = 0;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x) {
      if (rough.at(x, y) != smooth.at(x, y)) ++changed;
      bool isFlat = true;
      for (int c = 0; c < 3; ++c)
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          isFlat &= std::abs(rough.at(x + dx, y + dy)[c] - rough.at(x, y)[c]) <= 4;
      if (!isFlat) continue;
      ++flat;
      EXPECT_EQ(rough.at(x, y), smooth.at(x, y)) << x << ' ' << y;
    }
  EXPECT_GT(flat, 10000);
  EXPECT_GT(changed, 300);
}

// Lines are smooth by themselves; the edges under them must not blur them.
TEST(Fxaa, LeavesLinesAndPointsAlone) {
  REX_NEEDS_OSMESA();
  Picture picture{.polylines = {{{{-1, 0, -0.5}, {1, 0, 0.6}}, kRed, 3}},
                  .pointSets = {{.points = {{0, 0, 0.7}}, .color = kRed}}};
  picture.ground.visible = false;
  EXPECT_EQ(drawn(AntiAliasing::kFxaa, 1, picture), drawn(AntiAliasing::kNone, 1, picture));
}

TEST(Fxaa, HidesLinesBehindSolidsAsBefore) {
  REX_NEEDS_OSMESA();
  Picture picture = slanted();
  picture.polylines = {{{{-2, 1, 0}, {2, 1, 0}}, {0, 0, 1}, 6}};
  const Image rough = drawn(AntiAliasing::kNone, 1, picture), smooth = drawn(AntiAliasing::kFxaa, 1, picture);
  const auto hidden = smooth.at(kWidth / 2, kHeight / 2), open = smooth.at(kWidth / 4, kHeight / 2);
  EXPECT_GT(hidden[0], hidden[2]) << "faint, on red";
  EXPECT_GT(open[2], open[0] + 200) << "blue, before white";
  EXPECT_EQ(rough.at(kWidth / 2, kHeight / 2), hidden);
}

TEST(Fxaa, IsNamedInTheDescription) {
  REX_NEEDS_OSMESA();
  const Renderer renderer({.width = 8, .height = 8, .antiAliasing = AntiAliasing::kFxaa});
  EXPECT_TRUE(renderer.describe().ends_with(", FXAA")) << renderer.describe();
}

}  // namespace rex::anti_aliasing_test
