// A few whole pictures against stored ones. Set REX_UPDATE_GOLDEN=1 to store what is drawn now; look at it.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "geometry/welded_mesh.h"
#include "render/image.h"
#include "render/renderer.h"
#include "support/image_difference.h"
#include "support/mesh_samples.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::golden_test {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr Color kBlue{0.22f, 0.45f, 0.70f}, kOrange{0.85f, 0.45f, 0.2f}, kWood{0.75f, 0.63f, 0.48f};

void expectGolden(const std::string& name, const Picture& picture) {
  Renderer renderer({.width = 160, .height = 120});
  const Image actual = renderer.draw(picture, framing(bounds(picture), kDefaultView, 4. / 3));
  const fs::path golden = homeFolder() / "tests/golden/render" / (name + ".png");
  if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) writePng(actual, golden);
  const ImageDifference apart = imageDifference(readPng(golden), actual, 8);
  if (apart.largeShare <= 0.005 && apart.mean <= 0.5) return;
  const fs::path folder = ownFolder() / "tests-out" / "golden";
  fs::create_directories(folder);
  writePng(actual, folder / (name + "-actual.png"));
  writePng(apart.picture, folder / (name + "-difference.png"));
  ADD_FAILURE() << name << ": " << 100 * apart.largeShare << " % of the pixels differ by more than 8, "
                << apart.mean << " on average; see " << folder << ". Drawn by " << renderer.describe()
                << "; what drew the golden one is noted in tests/golden/render/README.md.";
}

TEST(Golden, ShapesAndShadows) {
  REX_NEEDS_OSMESA();
  Picture picture;
  picture.solids = {
      {{ShapeType::kBox, {0.5, 0.4, 0.6}, 0}, translation(0.5, 0, 0.3), kWood, "box"},
      {{.type = ShapeType::kSphere, .radius = 0.2}, translation(0.5, 0, 0.8), kOrange, "sphere"},
      {{ShapeType::kCylinder, {0, 0, 0.7}, 0.15}, translation(-0.1, 0.2, 0.35), kBlue, "cylinder"},
      {{ShapeType::kCapsule, {0, 0, 0.5}, 0.1},
       translation(-0.5, -0.3, 0.3) * rotation(1, {0, 1, 0.3}),
       kOrange,
       "capsule"}};
  expectGolden("shapes", picture);
}

TEST(Golden, Cones) {
  REX_NEEDS_OSMESA();
  Picture picture;
  picture.solids = {{{ShapeType::kCone, {0, 0, 0.7}, 0.25}, translation(-0.3, 0, 0.35), kOrange, "standing"},
                    {{ShapeType::kCone, {0, 0, 0.5}, 0.2},
                     translation(0.4, 0.2, 0.3) * rotation(2, {1, 0, 0.3}),
                     kBlue,
                     "lying"}};
  expectGolden("cones", picture);
}

TEST(Golden, LinesPointsAxesAndText) {
  REX_NEEDS_OSMESA();
  Picture picture;
  picture.solids = {
      {{.type = ShapeType::kSphere, .radius = 0.25}, translation(0, 0, 0.4), {0.8f, 0.8f, 0.8f}, "ball"}};
  Polyline spiral{.color = kOrange};
  for (int i = 0; i <= 90; ++i)
    spiral.points.emplace_back(0.5 * std::cos(0.2 * i), 0.5 * std::sin(0.2 * i), 0.01 * i);
  picture.polylines.push_back(spiral);
  picture.pointSets.push_back({.points = {{-0.5, -0.5, 0}, {0, -0.5, 0}, {0.5, -0.5, 0}}});
  picture.axes.push_back({translation(0.6, 0.3, 0), 0.4, "A"});
  picture.labels.push_back({"ball", {0, 0, 0.4}});
  picture.captions.push_back({"spiral", Corner::kTopLeft});
  expectGolden("overlay", picture);
}

TEST(Golden, TranslucentSolids) {
  REX_NEEDS_OSMESA();
  Picture picture;
  Color glass = kBlue;
  glass.a = 0.4f;
  picture.solids = {{{ShapeType::kBox, {0.3, 0.3, 0.3}, 0}, translation(0, 0.4, 0.15), kOrange, "behind"},
                    {{ShapeType::kBox, {0.8, 0.1, 0.5}, 0}, translation(0, 0, 0.25), glass, "pane"}};
  expectGolden("translucent", picture);
}

TEST(Golden, MeshesAndMarks) {
  REX_NEEDS_OSMESA();
  const BareMesh sphere = sphereSample(0.2f, 3), cube = cubeSample(0.12f);
  const auto half = static_cast<std::uint32_t>(sphere.triangles.size() / 2);
  const TriangleMesh ball = weldedMesh(sphere.positions, sphere.triangles,
                                       {{Eigen::Vector4f(0.2f, 0.4f, 0.7f, 1), 0, half}, {{}, half, half}});
  Picture picture;
  picture.solids = {
      {{.type = ShapeType::kMesh, .mesh = ball}, translation(-0.5, 0, 0.2), kWood, "ball"},
      {{.type = ShapeType::kMesh, .mesh = weldedMesh(cube.positions, cube.triangles)},
       translation(0, 0.3, 0.12) * rotation(0.5, {0, 0, 1}),
       kOrange,
       "cube"},
      {{ShapeType::kRoundedBox, {0.3, 0.3, 0.3}, 0.08}, translation(0.5, 0.2, 0.15), kBlue, "rounded box"}};
  picture.arrows = {{{-0.5, 0, 0.4}, {-0.3, 0, 0.75}, kOrange, 0.02}};
  picture.ellipsoids = {{translation(0.4, -0.3, 0.2) * rotation(0.4, {0, 1, 0}), {0.25, 0.1, 0.15}}};
  picture.pointSets = {{.points = {{0.4, -0.3, 0.2}, {0.5, -0.3, 0.15}, {0.2, -0.35, 0.3}}, .size = 4}};
  LineSet tree;
  const auto node = [](int level, int i) {
    return Vector3d(-0.7 + 0.8 * (i + 0.5) / (1 << level), -0.8 + 0.12 * level, 0.01);
  };
  for (int level = 1; level < 6; ++level)
    for (int i = 0; i < 1 << level; ++i) tree.segments.emplace_back(node(level - 1, i / 2), node(level, i));
  picture.lineSets = {tree};
  picture.labels = {{"A", {-0.5, 0, 0.2}}, {"B", {-0.5, 0, 0.2}}};
  expectGolden("marks", picture);
}

}  // namespace rex::golden_test
