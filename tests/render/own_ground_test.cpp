// Grounds that a scene brings along, and the checkered one, which must not shine through them.
#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "geometry/welded_mesh.h"
#include "render/film.h"
#include "render/glb.h"
#include "render/own_ground_internal.h"
#include "render/renderer.h"
#include "support/mesh_samples.h"
#include "support/needs_osmesa.h"

namespace rex::own_ground_test {

using Eigen::Vector3d;
using internal::checkerHeight;

constexpr Color kRed{0.9f, 0.05f, 0.05f};

// A sheet [-half, half]^2, seen from both sides; its winding says that it faces up, or down.
Solid sheet(float half, double height, bool facesUp = true) {
  BareMesh bare;
  bare.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  if (facesUp)
    bare.triangles = {{0, 1, 2}, {0, 2, 3}};
  else
    bare.triangles = {{0, 2, 1}, {0, 3, 2}};
  return {{.type = ShapeType::kMesh, .mesh = weldedMesh(bare.positions, bare.triangles)},
          translation(0, 0, height),
          kRed,
          "sheet"};
}

Solid box(const Vector3d& extent, const Vector3d& middle) {
  return {{ShapeType::kBox, extent, 0}, {.p = middle}, {0.2f, 0.3f, 0.9f}, "box"};
}

Solid meshOf(const BareMesh& bare, double height) {
  return {{.type = ShapeType::kMesh, .mesh = weldedMesh(bare.positions, bare.triangles)},
          translation(0, 0, height),
          kRed,
          "mesh"};
}

// A floor and a wall on it in one mesh.
BareMesh room() {
  BareMesh bare;
  bare.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {2, 2, 1}, {-2, 2, 1}};
  bare.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
  return bare;
}

std::optional<double> heightOf(const std::vector<Solid>& solids, double height = 0) {
  Picture picture{.solids = solids};
  picture.ground.height = height;
  return checkerHeight(picture, bounds(picture));
}

TEST(CheckerHeight, IsThatOfTheGround) {
  EXPECT_EQ(heightOf({}), 0);
  EXPECT_EQ(heightOf({box({1, 1, 1}, {0, 0, 0.5})}), 0);
  EXPECT_EQ(heightOf({box({1, 1, 1}, {0, 0, -0.5})}, -1), -1);
  EXPECT_EQ(heightOf({meshOf(cubeSample(0.5f), 0.5)}), 0) << "its underside is never seen";
  EXPECT_EQ(heightOf({meshOf(sphereSample(0.5f, 3), 0.5)}), 0);
  EXPECT_EQ(heightOf({box({4, 4, 0.2}, {0, 0, -0.1})}, -0.2), -0.2) << "a slab hides it";
  Picture picture{.solids = {box({1, 1, 1}, {0, 0, 0.5})}};
  picture.ground.visible = false;
  EXPECT_EQ(checkerHeight(picture, bounds(picture)), std::nullopt);
}

TEST(CheckerHeight, IsNoneWhereTheSceneHasAGround) {
  const Solid robot = box({0.5, 0.5, 1}, {0, 0, 0.5});
  EXPECT_EQ(heightOf({sheet(2, 0), robot}), std::nullopt);
  EXPECT_EQ(heightOf({sheet(2, 0, false), robot}), std::nullopt);
  EXPECT_EQ(heightOf({box({4, 4, 0.001}, {0, 0, 0}), robot}), std::nullopt);
  EXPECT_EQ(heightOf({meshOf(room(), 0), robot}), std::nullopt);
  EXPECT_EQ(heightOf({sheet(2, 0), box({0.5, 0.5, 1}, {0, 0, 0.48})}, -0.02), std::nullopt)
      << "feet sink in a little";
  Solid glass = sheet(2, 0);
  glass.color.a = 0.5f;
  EXPECT_EQ(heightOf({glass, robot}), std::nullopt);
}

TEST(CheckerHeight, IsLowerBelowWhatIsSmallAndFlat) {
  const Solid robot = box({4, 4, 1}, {0, 0, 0.5});
  for (const Solid& flat : {sheet(0.5f, 0), sheet(0.5f, 0.001), box({0.5, 0.5, 0.001}, {0, 0, 0.0005})}) {
    const std::optional<double> height = heightOf({robot, flat});
    ASSERT_TRUE(height.has_value());
    EXPECT_LT(*height, -0.002);
    EXPECT_GT(*height, -0.004) << "a thousandth of the radius, 2.9 m";
  }
  EXPECT_EQ(heightOf({robot, sheet(0.5f, 0.1)}), 0) << "far enough above";
  EXPECT_EQ(heightOf({robot, sheet(0.5f, -1)}), 0) << "far below";
  Solid invisible = sheet(0.5f, 0);
  invisible.color.a = 0;
  EXPECT_EQ(heightOf({robot, invisible}), 0);
}

TEST(CheckerHeight, TakesNoPointsForAGround) {
  Solid cloud = sheet(2, 0);
  cloud.shape.type = ShapeType::kPointCloud;
  EXPECT_EQ(heightOf({cloud, box({0.5, 0.5, 1}, {0, 0, 0.5})}), 0);
}

bool isRed(const Image& image, int x, int y) {
  const auto rgb = image.at(x, y);
  return rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2];
}

// Whether all pixels are red in the middle of the square that the sheet takes, two thirds of it.
bool isAllRed(const Picture& picture, float half, const Camera& camera) {
  static Renderer renderer({.width = 160, .height = 120, .antiAliasing = AntiAliasing::kNone});
  const Image image = renderer.draw(picture, camera);
  for (int i = 0; i <= 80; ++i)
    for (int k = 0; k <= 80; ++k) {
      const Vector3d p_WQ(half * float(i - 40) / 60, half * float(k - 40) / 60, 0);
      const auto at = project(camera, p_WQ, image.width, image.height);
      if (!at || at->x < 0 || at->y < 0 || at->x >= image.width || at->y >= image.height) continue;
      if (!isRed(image, static_cast<int>(at->x), static_cast<int>(at->y))) return false;
    }
  return true;
}

// Where two surfaces fight, a camera that moves by a tenth of a millimetre shows other pixels of each.
TEST(OwnGround, NeverMixesWithTheCheckers) {
  REX_NEEDS_OSMESA();
  const Picture whole{.solids = {sheet(2, 0), box({0.1, 0.1, 0.1}, {2.5, 0, 0.05})}};
  Picture tile{.solids = {sheet(0.5f, 0), box({3, 1, 1}, {0, 2.5, 0.5})}};
  for (int step = 0; step < 12; ++step) {
    const double shift = 1e-4 * step;
    EXPECT_TRUE(isAllRed(whole, 2, lookAt({3 + shift, -4, 1.5 + shift}, {0, 0, 0}))) << step;
    EXPECT_TRUE(isAllRed(tile, 0.5f, lookAt({1.5 + shift, -2.5, 0.9 + shift}, {0, 0, 0}))) << step;
    EXPECT_TRUE(isAllRed(tile, 0.5f, framing(bounds(tile), {1 + shift, -2, 1.2}, 4. / 3))) << step;
  }
  tile.ground.visible = false;
  EXPECT_TRUE(isAllRed(tile, 0.5f, lookAt({1.5, -2.5, 0.9}, {0, 0, 0}))) << "what the test looks at";
}

TEST(OwnGround, IsTheOnlyOneOfAReplay) {
  const auto countOf = [](const std::vector<Solid>& solids) {
    const std::string bytes = toGlb({{0, {.solids = solids}}});
    std::size_t count = 0;
    for (std::size_t at = 0; (at = bytes.find("\"ground\"", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(countOf({box({1, 1, 1}, {0, 0, 0.5})}), 1u);
  EXPECT_EQ(countOf({box({1, 1, 1}, {0, 0, 0.5}), sheet(2, 0)}), 0u);
}

}  // namespace rex::own_ground_test
