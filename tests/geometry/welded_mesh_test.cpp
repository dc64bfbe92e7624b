#include "geometry/welded_mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shape.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"

namespace rex::welded_mesh_test {

using Eigen::Vector3f;

// Every triangle with corners of its own, as STL has them.
BareMesh exploded(const BareMesh& mesh) {
  BareMesh result;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const std::uint32_t corner : triangle) result.positions.push_back(mesh.positions[corner]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(WeldedMesh, KeepsTheEdgesOfACubeSharp) {
  const BareMesh cube = exploded(cubeSample(0.5f));
  const TriangleMesh mesh = weldedMesh(cube.positions, cube.triangles);
  EXPECT_EQ(mesh.positions().size(), 24u) << "three normals at each of eight corners";
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_NEAR(volumeOf(mesh), 1, 1e-6);
  EXPECT_NEAR(areaOf(mesh), 6, 1e-6);
  EXPECT_EQ(mesh.halfBounds(), Eigen::Vector3d(0.5, 0.5, 0.5));
  for (std::size_t i = 0; i < mesh.normals().size(); ++i) {
    EXPECT_NEAR(mesh.normals()[i].cwiseAbs().maxCoeff(), 1, 1e-6);
    EXPECT_NEAR(mesh.normals()[i].dot(mesh.positions()[i]), 0.5, 1e-6) << "outward";
  }
}

TEST(WeldedMesh, SmoothsASphere) {
  const BareMesh sphere = exploded(sphereSample(2, 3));
  const TriangleMesh mesh = weldedMesh(sphere.positions, sphere.triangles);
  EXPECT_EQ(mesh.positions().size(), 258u) << "4^(n+1) + 2 vertices of an octahedron cut n times";
  for (std::size_t i = 0; i < mesh.normals().size(); ++i) {
    EXPECT_NEAR(mesh.normals()[i].norm(), 1, 1e-6);
    EXPECT_GT(mesh.normals()[i].dot(mesh.positions()[i]) / 2, std::cos(0.03)) << "radial within 0.03 rad";
  }
  const TriangleMesh faceted = weldedMesh(sphere.positions, sphere.triangles, {}, 0.01);
  EXPECT_GT(faceted.positions().size(), 1400u) << "almost three for each of 512 triangles";
}

// The normal at the tip of a flat fan does not lean towards the side that is cut into more triangles.
TEST(WeldedMesh, WeighsByAngle) {
  const auto atTip = [](int leftPieces) {
    std::vector<Vector3f> positions = {{0, 0, 0}, {1, 0, 0}};
    std::vector<TriangleMesh::Triangle> triangles;
    for (int i = 1; i <= leftPieces; ++i) {
      const double angle = std::numbers::pi * i / leftPieces;
      positions.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                             0.2f * static_cast<float>(std::sin(angle)));
      triangles.push_back({0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
    }
    const auto left = static_cast<std::uint32_t>(leftPieces + 1);
    positions.emplace_back(0.f, -1.f, 0.2f);
    triangles.push_back({0, left, left + 1});
    triangles.push_back({0, left + 1, 1});
    return weldedMesh(positions, triangles).normals()[0];
  };
  EXPECT_LT((atTip(2) - Vector3f::UnitZ()).norm(), 1e-5f);
  EXPECT_LT((atTip(20) - Vector3f::UnitZ()).norm(), 0.01f);
}

// One vertex for each corner at the tip: of so many, none is searched for one like it.
TEST(WeldedMesh, LeavesALargeFanFlat) {
  constexpr int kPieces = 300;
  std::vector<Vector3f> positions = {{0, 0, 0}};
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i <= kPieces; ++i) {
    const double angle = i * std::numbers::pi / kPieces;
    positions.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.f);
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  const TriangleMesh mesh = weldedMesh(positions, triangles);
  EXPECT_EQ(mesh.triangles().size(), 300u);
  EXPECT_EQ(mesh.positions().size(), 300u + 301u);
  for (const Vector3f& normal : mesh.normals()) EXPECT_LT((normal - Vector3f::UnitZ()).norm(), 1e-6f);
}

TEST(WeldedMesh, DropsTrianglesWithoutArea) {
  BareMesh cube = cubeSample(0.5f);
  cube.triangles.push_back({0, 0, 1});
  cube.triangles.push_back({7, 7, 7});
  cube.positions.emplace_back(0.f, 0.f, 0.5f);
  cube.triangles.push_back({4, 8, 7});  // on the diagonal of the top
  const std::vector<TriangleMesh::Part> parts = {
      {.color = Eigen::Vector4f::Ones(), .firstTriangle = 0, .triangleCount = 12},
      {.color = std::nullopt, .firstTriangle = 12, .triangleCount = 3}};
  const TriangleMesh mesh = weldedMesh(cube.positions, cube.triangles, parts);
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_EQ(mesh.parts().size(), 1u) << "a part of nothing is none";
  EXPECT_EQ(mesh.parts()[0].color, Eigen::Vector4f::Ones());
  EXPECT_TRUE(weldedMesh({Vector3f::Zero(), Vector3f::UnitX()}, {{0, 1, 0}}).isEmpty());
  EXPECT_TRUE(weldedMesh({}, {}).isEmpty());
}

TEST(WeldedMesh, TurnsAClosedSurfaceThatIsInsideOut) {
  BareMesh cube = cubeSample(0.5f);
  for (auto& triangle : cube.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(volumeOf(weldedMesh(cube.positions, cube.triangles)), 1, 1e-6);
  // An open one keeps its winding: nobody can tell its outside.
  cube.triangles.pop_back();
  EXPECT_LT(volumeOf(weldedMesh(cube.positions, cube.triangles)), -0.8);
}

TEST(WeldedMesh, GivesThePointOfALargeFanItsFaces) {
  std::vector<Vector3f> positions = {{0, 0, 1}};
  std::vector<TriangleMesh::Triangle> triangles;
  constexpr std::uint32_t kPieces = 300;
  for (std::uint32_t i = 0; i < kPieces; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kPieces;
    positions.emplace_back(std::cos(angle), std::sin(angle), 0.f);
    triangles.push_back({0, i + 1, i + 1 < kPieces ? i + 2 : 1});
  }
  EXPECT_GT(weldedMesh(positions, triangles).positions().size(), 2 * kPieces - 50);
}

TEST(WeldedMesh, RefusesABadIndex) {
  EXPECT_REX_ERROR(weldedMesh({Vector3f::Zero()}, {{0, 0, 1}}), "mesh: found triangle 0 with corner 1");
}

}  // namespace rex::welded_mesh_test
