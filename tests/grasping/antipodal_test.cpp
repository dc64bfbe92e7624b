#include <cmath>

#include <gtest/gtest.h>

#include "formats/mesh_reader.h"
#include "geometry/welded_mesh.h"
#include "grasping/equilibrium.h"
#include "grasping/object_surface.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"
#include "support/paths.h"

namespace rex::antipodal_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

Shape meshShape(const BareMesh& mesh) {
  return {.type = ShapeType::kMesh, .mesh = weldedMesh(mesh.positions, mesh.triangles)};
}

// Two plates across x, each 2 cm thick.
Shape twoPlates(float gap) {
  BareMesh both;
  for (const float side : {-1.f, 1.f}) {
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    for (Eigen::Vector3f p : cubeSample(0.5f).positions) {
      p = p.cwiseProduct(Eigen::Vector3f(0.02f, 0.2f, 0.2f));
      p.x() += side * (gap / 2 + 0.01f);
      both.positions.push_back(p);
    }
    for (const auto& [a, b, c] : cubeSample(0.5f).triangles)
      both.triangles.push_back({first + a, first + b, first + c});
  }
  return meshShape(both);
}

int all(const AntipodalGrasps& found) {
  return static_cast<int>(found.grasps.size()) + found.notOpposite + found.tooWide + found.blocked;
}

// Each line lies in both cones, both ends on the surface, and the pair holds every force through it.
void expectGrasps(const ObjectSurface& surface, const AntipodalGrasps& found,
                  const AntipodalOptions& options) {
  EXPECT_EQ(all(found), found.tries);
  for (const AntipodalGrasp& grasp : found.grasps) {
    const Vector3d way = grasp.b.p_OC - grasp.a.p_OC;
    EXPECT_NEAR(way.norm(), grasp.width, 1e-12);
    EXPECT_LE(grasp.width, options.maxWidth);
    const double cone = std::atan(options.friction) + 1e-9;
    EXPECT_LE(std::acos(way.normalized().dot(grasp.a.normal_O)), cone);
    EXPECT_LE(std::acos(-way.normalized().dot(grasp.b.normal_O)), cone);
    const std::vector<LineHit> hits = surface.hits(grasp.b.p_OC, grasp.b.normal_O);
    EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [](const LineHit& h) { return std::abs(h.t) < 1e-9; }));
  }
}

TEST(Antipodal, FindsGraspsOnAllShapes) {
  Rng rng(61);
  const AntipodalOptions options{.friction = 0.4, .maxWidth = 0.12};
  for (const Shape& shape : {Shape{.type = ShapeType::kBox, .extent = {0.1, 0.05, 0.3}},
                             Shape{.type = ShapeType::kSphere, .radius = 0.05},
                             Shape{.type = ShapeType::kCapsule, .extent = {0, 0, 0.2}, .radius = 0.04},
                             Shape{.type = ShapeType::kCylinder, .extent = {0, 0, 0.2}, .radius = 0.04},
                             meshShape(sphereSample(0.05f, 3)), meshShape(cubeSample(0.05f))}) {
    const ObjectSurface surface(shape);
    const AntipodalGrasps found = sampleAntipodal(surface, rng, 400, options);
    expectGrasps(surface, found, options);
    EXPECT_GT(found.grasps.size(), 20u) << toString(shape.type);
  }
}

// By another algorithm: whatever does not turn the object about the line of the jaws is held.
TEST(Antipodal, GraspsHoldWhatDoesNotTurnAboutThem) {
  Rng rng(62);
  const AntipodalOptions options{.friction = 0.3, .maxWidth = 0.2};
  const ObjectSurface surface({.type = ShapeType::kCylinder, .extent = {0, 0, 0.1}, .radius = 0.05});
  const AntipodalGrasps found = sampleAntipodal(surface, rng, 200, options);
  ASSERT_GT(found.grasps.size(), 20u);
  for (const AntipodalGrasp& grasp : found.grasps) {
    const WrenchReference middle{(grasp.a.p_OC + grasp.b.p_OC) / 2, 0.1};
    const std::vector<WrenchCone> cones = wrenchCones(std::vector{grasp.a, grasp.b}, middle);
    VectorXd load = rng.normalVector(6);
    const Vector3d line = (grasp.b.p_OC - grasp.a.p_OC).normalized();
    load.tail<3>() -= line * line.dot(load.tail<3>());
    EXPECT_EQ(equilibrium(cones, load).status, EquilibriumStatus::kHeld);
    load.tail<3>() += line;
    EXPECT_EQ(equilibrium(cones, load).status, EquilibriumStatus::kNotHeld);
  }
}

TEST(Antipodal, LeavesOutWhatJawsCannotReach) {
  Rng rng(63);
  // Through both plates 14 cm; one plate alone only if the open jaw fits between them.
  const AntipodalOptions options{.friction = 0.1, .maxWidth = 0.1};
  const ObjectSurface narrow(twoPlates(0.03f)), wide(twoPlates(0.05f));
  const AntipodalGrasps none = sampleAntipodal(narrow, rng, 300, options);
  // Slanted lines pass the other plate only near its rim: 4 cm of way, of slope 0.1 and less.
  for (const AntipodalGrasp& grasp : none.grasps)
    EXPECT_GT(grasp.b.p_OC.tail<2>().cwiseAbs().maxCoeff(), 0.1 - 0.1 * 0.041);
  EXPECT_LT(none.grasps.size(), 30u);
  EXPECT_GT(none.blocked, 100);
  EXPECT_GT(none.tooWide, 10);  // across the plates
  const AntipodalGrasps some = sampleAntipodal(wide, rng, 300, options);
  EXPECT_GT(some.grasps.size(), 100u);
  EXPECT_EQ(some.blocked, 0);
  expectGrasps(wide, some, options);
  const ObjectSurface ball({.type = ShapeType::kSphere, .radius = 0.06});
  const AntipodalGrasps tooWide = sampleAntipodal(ball, rng, 100, options);
  EXPECT_TRUE(tooWide.grasps.empty());
  EXPECT_EQ(tooWide.tooWide, 100);
}

TEST(Antipodal, FindsTheWallAndHandleOfAMug) {
  Rng rng(64);
  const ObjectSurface mug({.type = ShapeType::kMesh, .mesh = readMesh(sourcePath("data/meshes/mug.stl"))});
  const AntipodalOptions options{.friction = 0.5, .maxWidth = 0.03};
  const AntipodalGrasps found = sampleAntipodal(mug, rng, 500, options);
  expectGrasps(mug, found, options);
  EXPECT_GT(found.grasps.size(), 20u);
}

TEST(Antipodal, IsTheSameForTheSameSeed) {
  const ObjectSurface surface({.type = ShapeType::kSphere, .radius = 0.04});
  Rng a(5), b(5);
  const AntipodalGrasps first = sampleAntipodal(surface, a, 50), second = sampleAntipodal(surface, b, 50);
  ASSERT_EQ(first.grasps.size(), second.grasps.size());
  for (std::size_t k = 0; k < first.grasps.size(); ++k)
    EXPECT_EQ(first.grasps[k].b.p_OC, second.grasps[k].b.p_OC);
  EXPECT_TRUE(sampleAntipodal(surface, a, 0).grasps.empty());
}

TEST(Antipodal, RefusesBadInput) {
  const ObjectSurface surface({.type = ShapeType::kSphere, .radius = 0.04});
  Rng rng(1);
  EXPECT_REX_ERROR(sampleAntipodal(surface, rng, -1), "antipodal grasps: tries: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(sampleAntipodal(surface, rng, 1, {.friction = 0}),
                   "antipodal grasps: friction: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(
      sampleAntipodal(surface, rng, 1, {.maxWidth = HUGE_VAL}),
      "antipodal grasps: largest width: found inf m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(contactsAt(surface.sample(rng, 1), -1), "contact: friction: found -1");
}

}  // namespace rex::antipodal_test
