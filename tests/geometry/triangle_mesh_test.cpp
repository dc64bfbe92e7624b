#include "geometry/triangle_mesh.h"

#include <limits>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::triangle_mesh_test {

using Part = TriangleMesh::Part;

constexpr float kInf = std::numeric_limits<float>::infinity();
const std::vector<Eigen::Vector3f> kPositions = {{0, 0, 0}, {1, 0, 0}, {0, -2, 0}, {0, 0, 1}};
const std::vector<Eigen::Vector3f> kNormals(4, Eigen::Vector3f::UnitZ());
const std::vector<TriangleMesh::Triangle> kTriangles = {{0, 1, 2}, {0, 1, 3}};

TEST(TriangleMesh, KeepsWhatItWasGiven) {
  const TriangleMesh mesh(kPositions, kNormals, kTriangles,
                          {{.triangleCount = 1}, {.firstTriangle = 1, .triangleCount = 1}});
  EXPECT_EQ(mesh.positions().size(), 4u);
  EXPECT_EQ(mesh.parts().size(), 2u);
  EXPECT_EQ(mesh.halfBounds(), Eigen::Vector3d(1, 2, 1));
  const TriangleMesh one(kPositions, kNormals, kTriangles);
  ASSERT_EQ(one.parts().size(), 1u);
  EXPECT_EQ(one.parts()[0].triangleCount, 2u);
  const TriangleMesh cloud(kPositions, {}, {});
  EXPECT_TRUE(cloud.parts().empty());
  EXPECT_FALSE(mesh == one);
  EXPECT_EQ(TriangleMesh(mesh), mesh);
}

TEST(TriangleMesh, IsEmptyUnlessItIsGivenSomething) {
  const TriangleMesh none;
  EXPECT_EQ(none.halfBounds(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(none.positions().empty() && none.normals().empty() && none.triangles().empty());
  EXPECT_TRUE(none.parts().empty());
}

TEST(TriangleMesh, NamesWhatIsWrong) {
  auto bad = kPositions;
  bad[2].y() = kInf;
  EXPECT_REX_ERROR(TriangleMesh(bad, kNormals, kTriangles),
                   "mesh: found vertex 2 = (0, inf, 0), wanted finite numbers");
  bad = kNormals;
  bad[3].x() = -kInf;
  EXPECT_REX_ERROR(TriangleMesh(kPositions, bad, kTriangles),
                   "mesh: found normal 3 = (-inf, 0, 1), wanted finite numbers");
  EXPECT_REX_ERROR(TriangleMesh(kPositions, {}, kTriangles),
                   "mesh: found 0 normals, wanted 4, one for each vertex");
  EXPECT_REX_ERROR(TriangleMesh(kPositions, {{0, 0, 1}}, {}), "mesh: found 1 normals, wanted 4");
  EXPECT_REX_ERROR(TriangleMesh(kPositions, kNormals, {{0, 1, 2}, {0, 4, 1}}),
                   "mesh: found triangle 1 with corner 4, wanted indices below 4, the number of vertices");
  EXPECT_REX_ERROR(
      TriangleMesh(kPositions, kNormals, kTriangles,
                   {Part{.triangleCount = 1}, Part{.firstTriangle = 0, .triangleCount = 1}}),
      "mesh: found part 1 starting at triangle 0, wanted triangle 1, where the part before ends");
  EXPECT_REX_ERROR(TriangleMesh(kPositions, kNormals, kTriangles, {Part{.triangleCount = 1}}),
                   "mesh: found parts with 1 triangles in total, wanted all 2");
}

}  // namespace rex::triangle_mesh_test
