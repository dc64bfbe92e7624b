// Meshes in pictures, compared with the shapes that they stand for.
#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "geometry/welded_mesh.h"
#include "kinematics/forward_kinematics.h"
#include "render/mesh_store_internal.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "scene/model.h"
#include "scene/scene_spec.h"
#include "support/draw_once.h"
#include "support/image_difference.h"
#include "support/mesh_samples.h"
#include "support/needs_osmesa.h"

namespace rex::imported_mesh_test {

using Eigen::Vector3d;
using Eigen::Vector4f;

constexpr Color kRed{0.9f, 0.1f, 0.1f};
constexpr RendererOptions kSmall{.width = 160, .height = 120};

Shape meshShape(const BareMesh& bare, double creaseAngle = kCreaseAngle) {
  return {.type = ShapeType::kMesh, .mesh = weldedMesh(bare.positions, bare.triangles, {}, creaseAngle)};
}

Solid upright(const Shape& shape) {
  return {shape, rotation(0.4, {0, 0, 1}) * translation(0.1, 0, 0.7), kRed, "it"};
}

TEST(ImportedMesh, LooksLikeTheShapeItStandsFor) {
  REX_NEEDS_OSMESA();
  const struct {
    Shape mesh, shape;
  } pairs[] = {{meshShape(cubeSample(0.5f)), {ShapeType::kBox, {1, 1, 1}, 0}},
               {meshShape(sphereSample(0.5f, 5)), {.type = ShapeType::kSphere, .radius = 0.5}}};
  for (const auto& [mesh, shape] : pairs) {
    const Picture asMesh{.solids = {upright(mesh)}}, asShape{.solids = {upright(shape)}};
    // The box around a turned sphere is larger than that around its mesh.
    const Camera camera = framing(bounds(asShape), kDefaultView, 160. / 120);
    Renderer renderer(kSmall);
    const ImageDifference apart =
        imageDifference(renderer.draw(asMesh, camera), renderer.draw(asShape, camera), 8);
    // Its shadow too is the same.
    EXPECT_LT(apart.largeShare, 0.012) << toString(shape.type);
    EXPECT_LT(apart.mean, 0.6) << toString(shape.type);
  }
}

TEST(ImportedMesh, IsSmoothOnlyBelowItsCreaseAngle) {
  REX_NEEDS_OSMESA();
  const auto steps = [](double creaseAngle) {
    const Image image =
        drawOnce({.solids = {upright(meshShape(sphereSample(0.5f, 2), creaseAngle))}}, kSmall);
    int found = 0;
    for (int y = 1; y < image.height; ++y)
      for (int x = 1; x < image.width; ++x) {
        const auto a = image.at(x, y), b = image.at(x - 1, y);
        const bool bothOnIt = a[0] > 2 * a[1] && b[0] > 2 * b[1];
        found += bothOnIt && std::abs(a[0] - b[0]) > 8 ? 1 : 0;
      }
    return found;
  };
  EXPECT_LT(steps(kCreaseAngle), 60);
  EXPECT_GT(steps(0.01), 150);
}

TEST(ImportedMesh, ShowsTheColoursOfItsParts) {
  REX_NEEDS_OSMESA();
  const BareMesh cube = cubeSample(0.5f);  // its first four triangles are those of the bottom and the top
  std::vector<TriangleMesh::Part> parts(2);
  parts[0].triangleCount = parts[1].firstTriangle = 4;
  parts[1].triangleCount = 8;
  parts[0].color = Vector4f(0, 0, 1, 1);
  Solid solid{
      {.type = ShapeType::kMesh, .mesh = weldedMesh(cube.positions, cube.triangles, parts)}, {}, kRed, ""};
  const Camera camera = lookAt({0, -3, 3}, {0, 0, 0});
  Renderer renderer(kSmall);
  const auto colorAt = [&](const Picture& picture, const Vector3d& p_WQ) {
    const auto at = project(camera, p_WQ, kSmall.width, kSmall.height);
    return renderer.draw(picture, camera).at(static_cast<int>(at->x), static_cast<int>(at->y));
  };
  Picture picture{.solids = {solid}};
  const auto top = colorAt(picture, {0, 0, 0.5}), front = colorAt(picture, {0, -0.5, 0});
  EXPECT_GT(top[2], 2 * top[0] + 50) << "its own blue";
  EXPECT_GT(front[0], 2 * front[2] + 50) << "red like the solid";
  picture.solids[0].color.a = 0.5f;
  picture.solids.push_back({{ShapeType::kBox, {0.2, 0.2, 0.2}, 0}, {}, {0, 1, 0}, "inside"});
  const auto inside = colorAt(picture, {0, -0.15, 0});
  EXPECT_GT(inside[1], front[1] + 30) << "the opacity of the solid counts for all parts";
}

TEST(ImportedMesh, IsSeenFromBothSidesWhenOpen) {
  REX_NEEDS_OSMESA();
  BareMesh sheet;
  sheet.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  Picture picture{.solids = {{meshShape(sheet), {}, kRed, "sheet"}}};
  picture.ground.visible = false;
  picture.toLight = {0, -1, 1};
  Renderer renderer(kSmall);
  const auto front = renderer.draw(picture, lookAt({0, -4, 0}, {0, 0, 0})).at(80, 60);
  const auto back = renderer.draw(picture, lookAt({0, 4, 0}, {0, 0, 0})).at(80, 60);
  EXPECT_GT(back[0], 2 * back[1]);
  EXPECT_LT(back[0], front[0] - 20) << "its back is turned away from the light";
  // Wound the other way, the light shines on what the file calls its back.
  for (TriangleMesh::Triangle& triangle : sheet.triangles) std::swap(triangle[0], triangle[1]);
  picture.solids[0].shape = meshShape(sheet);
  const auto lit = renderer.draw(picture, lookAt({0, -4, 0}, {0, 0, 0})).at(80, 60);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], front[c], 2);
}

TEST(ImportedMesh, WithoutTrianglesIsDrawnAsPoints) {
  REX_NEEDS_OSMESA();
  const TriangleMesh points({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {}, {});
  for (const ShapeType type : {ShapeType::kPointCloud, ShapeType::kMesh}) {
    Picture picture{.solids = {{{.type = type, .mesh = points}, translation(0, 0, 1), kRed, "points"}}};
    picture.ground.visible = false;
    const Camera camera = lookAt({0, -5, 1}, {0, 0, 1});
    const Image image = Renderer(kSmall).draw(picture, camera);
    int red = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) red += image.at(x, y)[0] > image.at(x, y)[1] + 40 ? 1 : 0;
    EXPECT_GT(red, 4 * 5);
    EXPECT_LT(red, 4 * 14) << "discs of 3 pixels";
    const auto at = project(camera, {1, 0, 1}, image.width, image.height);
    const auto rgb = image.at(static_cast<int>(at->x), static_cast<int>(at->y));
    EXPECT_GT(rgb[0], rgb[1] + 60);
  }
}

TEST(ImportedMesh, OfASceneIsDrawnWhenItIsLoaded) {
  SceneSpec spec;
  const auto add = [&](const TriangleMesh& mesh) {
    spec.worldShapes.push_back({.name = "", .X_BS = {}, .shape = {.type = ShapeType::kMesh, .mesh = mesh}});
  };
  add({});
  add(meshShape(cubeSample(0.5f)).mesh);
  const Model model = compile(spec);
  const Picture picture = scenePicture(model, forwardKinematics(model, model.initialPositions()));
  ASSERT_EQ(picture.solids.size(), 1u);
  EXPECT_EQ(picture.solids[0].shape.mesh, spec.worldShapes[1].shape.mesh);
  EXPECT_EQ(picture.ground.height, -0.5);
}

TEST(MeshStore, ForgetsMeshesThatPicturesNoLongerUse) {
  REX_NEEDS_OSMESA();
  const auto context = makeGlContext();
  context->makeCurrent();
  const internal::GlFunctions gl = internal::loadGlFunctions(*context);
  internal::MeshStore store(gl);
  const auto prepare = [&](const Shape& shape) {
    store.prepare(internal::makeDrawList({.solids = {upright(shape), upright(shape)}}, Camera{}, 100));
  };
  const Shape kept = meshShape(cubeSample(1));
  for (int i = 0; i < 40; ++i) {
    prepare(meshShape(cubeSample(0.5f)));
    if (i % 4 == 0) prepare(kept);
    EXPECT_LE(store.importedCount(), 10u);
  }
  for (int i = 0; i < 10; ++i) prepare(kept);
  EXPECT_EQ(store.importedCount(), 1u);
  internal::requireNoGlError(gl, "forgetting meshes");
}

}  // namespace rex::imported_mesh_test
