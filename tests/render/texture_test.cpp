// Painted meshes, compared with ones whose parts have the same colours.
#include <gtest/gtest.h>

#include "geometry/welded_mesh.h"
#include "render/renderer.h"
#include "support/image_difference.h"
#include "support/mesh_samples.h"
#include "support/needs_osmesa.h"

namespace rex::texture_test {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr RendererOptions kSmall{.width = 160, .height = 120};

// Squares of 32 x 32 pixels: red and green below blue and white.
Texture fourColours() {
  Texture texture{64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool right = x >= 32, top = y >= 32;
      texture.rgb.push_back(!right && top ? 0 : right && !top ? 0 : 255);
      texture.rgb.push_back(right ? 255 : 0);
      texture.rgb.push_back(top ? 255 : 0);
    }
  return texture;
}

const Vector4f kColours[2][2] = {{{1, 0, 0, 1}, {0, 1, 0, 1}}, {{0, 0, 1, 1}, {1, 1, 1, 1}}};  // [up][right]

// [-1, 1]^2 in the plane of x and z, painted `repeats` times each way.
TriangleMesh painted(float repeats = 1) {
  const std::vector<Vector3f> positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  std::vector<Vector2f> points;
  for (const Vector3f& p : positions)
    points.push_back(repeats * (Vector2f(p.x(), p.z()) + Vector2f::Ones()) / 2);
  const TriangleMesh::Part part{.color = Vector4f::Ones(), .triangleCount = 2, .texture = 0};
  return weldedMesh(positions, {{0, 1, 2}, {0, 2, 3}}, {part}, kCreaseAngle, {points, {fourColours()}});
}

// The same of squares in plain colours.
TriangleMesh pieced(int repeats = 1) {
  BareMesh bare;
  std::vector<TriangleMesh::Part> parts;
  const int n = 2 * repeats;
  for (int up = 0; up < n; ++up)
    for (int right = 0; right < n; ++right) {
      const auto first = static_cast<std::uint32_t>(bare.positions.size());
      const auto at = [&](int i, int k) {
        return Vector3f(2.f * static_cast<float>(right + i) / static_cast<float>(n) - 1, 0,
                        2.f * static_cast<float>(up + k) / static_cast<float>(n) - 1);
      };
      for (const Vector3f& p : {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}) bare.positions.push_back(p);
      parts.push_back({.color = kColours[up % 2][right % 2],
                       .firstTriangle = static_cast<std::uint32_t>(bare.triangles.size()),
                       .triangleCount = 2});
      bare.triangles.push_back({first, first + 1, first + 2});
      bare.triangles.push_back({first, first + 2, first + 3});
    }
  return weldedMesh(bare.positions, bare.triangles, parts);
}

Picture pictureWith(const TriangleMesh& mesh) {
  Picture picture{.solids = {{{.type = ShapeType::kMesh, .mesh = mesh}, {.p = {0, 0, 1}}, {}, "square"},
                             {{ShapeType::kBox, {0.5, 0.5, 0.5}, 0}, {.p = {1.2, 0, 0.25}}, {}, "box"}}};
  return picture;
}

TEST(TexturedMesh, LooksLikeOneInPieces) {
  REX_NEEDS_OSMESA();
  for (const int repeats : {1, 2}) {
    Renderer renderer(kSmall);
    for (const Vector3d& eye : {Vector3d(0.5, -5, 1.5), Vector3d(-2, -4, 3), Vector3d(1, 5, 1)}) {
      const Camera camera = lookAt(eye, {0, 0, 1});
      const ImageDifference apart =
          imageDifference(renderer.draw(pictureWith(painted(static_cast<float>(repeats))), camera),
                          renderer.draw(pictureWith(pieced(repeats)), camera), 24);
      EXPECT_LT(apart.largeShare, 0.05) << repeats << ": only along the seams";
      EXPECT_LT(apart.mean, 3) << repeats;
    }
  }
}

TEST(TexturedMesh, IsMultipliedWithItsColour) {
  REX_NEEDS_OSMESA();
  const TriangleMesh mesh = painted();
  const TriangleMesh red({mesh.positions().begin(), mesh.positions().end()},
                         {mesh.normals().begin(), mesh.normals().end()},
                         {mesh.triangles().begin(), mesh.triangles().end()},
                         {{.color = Vector4f(1, 0, 0, 1), .triangleCount = 2, .texture = 0}}, mesh.paint());
  const Camera camera = lookAt({0, -5, 1}, {0, 0, 1});
  const Image image = Renderer(kSmall).draw(pictureWith(red), camera);
  const auto colorAt = [&](double x, double z) {
    const auto at = project(camera, {x, 0, z}, image.width, image.height);
    return image.at(static_cast<int>(at->x), static_cast<int>(at->y));
  };
  EXPECT_GT(colorAt(0.5, 1.5)[0], 2 * colorAt(0.5, 1.5)[1] + 40) << "white becomes red";
  EXPECT_LT(colorAt(-0.5, 1.5)[2], 110) << "blue becomes black, but for its shine";
}

// Corners at one place, of one normal, but with different points.
TEST(TexturedMesh, HasSeams) {
  BareMesh cube = cubeSample(1);
  std::vector<Vector3f> positions;
  std::vector<Vector2f> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const auto& [a, b, c] : cube.triangles) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t corner : {a, b, c}) {
      points.emplace_back(static_cast<float>(positions.size()), 0.5f);
      positions.push_back(cube.positions[corner]);
    }
  }
  const TriangleMesh mesh = weldedMesh(positions, triangles, {}, kCreaseAngle, {points, {}});
  ASSERT_EQ(mesh.positions().size(), 36u);
  EXPECT_EQ(weldedMesh(positions, triangles).positions().size(), 24u);
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles()[i][k];
      const auto given = static_cast<std::size_t>(mesh.paint().points[vertex].x());
      EXPECT_EQ(given / 3, i) << "the order of triangles stays";
      EXPECT_EQ(mesh.positions()[vertex], positions[given]);
    }
}

// Those of an earlier picture do not stay bound.
TEST(TexturedMesh, MixesWithOthers) {
  REX_NEEDS_OSMESA();
  Picture both = pictureWith(painted());
  both.solids.push_back({{.type = ShapeType::kMesh, .mesh = pieced()}, {.p = {2.5, 0, 1}}, {}, "pieces"});
  both.solids.push_back({{.type = ShapeType::kMesh, .mesh = painted(3)}, {.p = {-2.5, 0, 1}}, {}, "thrice"});
  both.solids[0].color.a = 0.5f;
  const Camera camera = lookAt({0, -8, 3}, {0, 0, 1});
  Renderer renderer(kSmall);
  const Image first = renderer.draw(both, camera);
  const Image plain = renderer.draw(pictureWith(pieced()), camera);
  EXPECT_EQ(renderer.draw(both, camera), first);
  EXPECT_EQ(Renderer(kSmall).draw(both, camera), first);
  EXPECT_EQ(Renderer(kSmall).draw(pictureWith(pieced()), camera), plain);
}

}  // namespace rex::texture_test
