#include "formats/scaled_mesh.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/welded_mesh.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"

namespace rex::scaled_mesh_test {

using Eigen::Vector3d;
using Eigen::Vector3f;

TriangleMesh sphere() {
  const BareMesh bare = sphereSample(1, 3);
  return weldedMesh(bare.positions, bare.triangles);
}

TEST(ScaledMesh, IsTheSameDataAtItsSize) {
  const TriangleMesh mesh = sphere();
  EXPECT_EQ(scaledMesh(mesh, Vector3d::Ones(), "f"), mesh);
}

// The sphere becomes an ellipsoid, whose volume and normals have formulas; mirrored or not, outside is
// outside.
TEST(ScaledMesh, OfASphereIsAnEllipsoid) {
  Rng rng(1);
  const TriangleMesh mesh = sphere();
  for (int trial = 0; trial < 20; ++trial) {
    Vector3d scale = rng.uniformVector(3, 0.2, 3);
    for (double& factor : scale)
      if (rng.uniform(-1, 1) < 0) factor = -factor;
    const TriangleMesh scaled = scaledMesh(mesh, scale, "f");
    EXPECT_NEAR(volumeOf(scaled), volumeOf(mesh) * std::abs(scale.prod()), 1e-5 * std::abs(scale.prod()));
    EXPECT_LT((scaled.halfBounds() - mesh.halfBounds().cwiseProduct(scale.cwiseAbs())).norm(), 1e-6);
    ASSERT_EQ(scaled.positions().size(), mesh.positions().size());
    for (std::size_t i = 0; i < scaled.positions().size(); ++i) {
      const Vector3d p = scaled.positions()[i].cast<double>();
      const Vector3d gradient = p.cwiseQuotient(scale.cwiseAbs2());  // of (x/a)^2 + (y/b)^2 + (z/c)^2, half
      EXPECT_GT(scaled.normals()[i].cast<double>().dot(gradient.normalized()), 0.999);
      EXPECT_NEAR(scaled.normals()[i].norm(), 1, 1e-6);
    }
    const auto parts = scaled.parts();
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].triangleCount, mesh.triangles().size());
  }
}

TEST(ScaledMesh, OfPointsHasNoNormals) {
  const TriangleMesh cloud({{1, 2, 3}}, {}, {});
  const TriangleMesh scaled = scaledMesh(cloud, {2, -1, 0.5}, "f");
  EXPECT_EQ(scaled.positions()[0], Vector3f(2, -2, 1.5f));
  EXPECT_TRUE(scaled.normals().empty());
}

TEST(ScaledMesh, RefusesWhatIsNoSize) {
  const TriangleMesh mesh = sphere();
  for (const double bad : {0., 0.9e-9, -1.1e9, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_REX_ERROR(scaledMesh(mesh, {1, 1, bad}, "a.stl"), "a.stl: scale of the mesh: found (1, 1, ");
  EXPECT_REX_ERROR(scaledMesh(mesh, {1, 0, 1}, "a.stl"),
                   "wanted numbers from 1e-9 to 1e9, or their negatives");
  EXPECT_REX_ERROR(scaledMesh(mesh, {1, -2e6, 1}, "a.stl"),
                   "a.stl: scaled mesh: found a vertex at 2000000 m, wanted at most 1e6 m");
}

}  // namespace rex::scaled_mesh_test
