// The second opinions know the solids by formulas of their own. Apart: two planes through the nearest points,
// which lie on the solids, hold them away from each other; that proves the distance. In overlap, the same
// planes show that the way out is one; that none is shorter says the hull of all differences by qhull, or, of
// cylinders, a search through all directions.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "collision/convex_distance_internal.h"
#include "collision/proximity.h"
#include "geometry/convex_hull.h"
#include "geometry/rotation.h"
#include "support/convex_solid.h"
#include "support/hull_depth.h"
#include "support/rounds.h"

namespace rex::convex_distance_test {

using Eigen::Vector3d;
using internal::certifiedProximity;
using internal::CertifiedProximity;
using internal::convexProximity;

// A twentieth of them will do where sanitizers make everything slow.
#ifdef __SANITIZE_ADDRESS__
const int kPairs = 500;
#else
const int kPairs = rounds(2000, 10000);
#endif

Proximity between(const ConvexSolid& a, const ConvexSolid& b) {
  return convexProximity(a.shape, a.X_W, b.shape, b.X_W);
}

// How wide the cores lie apart along n, from B to A.
double width(const ConvexSolid& a, const ConvexSolid& b, const Vector3d& n) {
  return a.least(n) + b.least(-n);
}

// Closes in on the direction along which the cores are widest, as far as random steps lead uphill.
double climbed(const ConvexSolid& a, const ConvexSolid& b, Vector3d n, double step, Rng& rng) {
  double best = width(a, b, n);
  for (; step > 1e-6; step /= 4) {
    for (int i = 0; i < 12; ++i) {
      const Vector3d next = (n + step * rng.normalVector(3)).normalized();
      if (const double w = width(a, b, next); w > best) best = w, n = next;
    }
  }
  return best;
}

double widestByHull(const ConvexSolid& a, const ConvexSolid& b) {
  std::vector<Vector3d> differences;
  for (const Vector3d& p : a.corners_W)
    for (const Vector3d& q : b.corners_W) differences.push_back(p - q);
  return -hullDepth(differences);
}

// Directions evenly over the sphere, by the golden angle.
double widestBySearch(const ConvexSolid& a, const ConvexSolid& b, const Vector3d& found, Rng& rng) {
  constexpr int kCount = 300;
  double best = -std::numeric_limits<double>::infinity();
  Vector3d widest = found;
  for (int i = 0; i < kCount; ++i) {
    const double z = (2 * i + 1.) / kCount - 1, r = std::sqrt(1 - z * z), angle = i * 2.399963229728653;
    const Vector3d n(r * std::cos(angle), r * std::sin(angle), z);
    if (const double w = width(a, b, n); w > best) best = w, widest = n;
  }
  return std::max(climbed(a, b, widest, 0.1, rng), climbed(a, b, found, 1e-2, rng));
}

bool isCurved(const ConvexSolid& one) { return one.disc > 0 || one.shape.type == ShapeType::kEllipsoid; }

// What every answer must be, however shapes degenerate.
void expectSound(const ConvexSolid& a, const ConvexSolid& b, const Proximity& found, double tolerance) {
  const Vector3d n = found.normal_W;
  EXPECT_NEAR(n.norm(), 1, 1e-14);
  EXPECT_LE((found.p_WA - found.p_WB - found.distance * n).norm(), 1e-14);
  EXPECT_LE(a.outside(found.p_WA + a.sweep * n), tolerance);
  EXPECT_LE(b.outside(found.p_WB - b.sweep * n), tolerance);
  EXPECT_NEAR(found.distance, width(a, b, n) - a.sweep - b.sweep, 1e-9);
}

// True if the cores overlap.
bool expectProven(const ConvexSolid& a, const ConvexSolid& b, Rng& rng) {
  const CertifiedProximity certified = certifiedProximity(a.shape, a.X_W, b.shape, b.X_W);
  const Proximity& found = certified.proximity;
  const double gap = found.distance + a.sweep + b.sweep;
  EXPECT_GE(certified.slack, -1e-14);
  EXPECT_LE(certified.slack, gap > 0 ? 1e-9 : 1e-6);
  expectSound(a, b, found, gap > 0 ? 1e-9 : 1e-6);
  if (gap > 0) return false;
  if (isCurved(a) || isCurved(b)) {
    EXPECT_LE(widestBySearch(a, b, found.normal_W, rng), gap + 1e-6);
  } else {
    EXPECT_NEAR(gap, widestByHull(a, b), 1e-9);
  }
  return true;
}

Pose randomPlace(Rng& rng, double spread) {
  Pose X{expSO3(2 * rng.normalVector(3)), rng.uniformVector(3, -spread, spread)};
  if (rng.index(3) == 0) X.R = rotationFromRollPitchYaw(Vector3d(rng.index(4), 0, rng.index(4)) * M_PI_2);
  return X;
}

ConvexSolid randomSolid(Rng& rng, ShapeType type, double spread) {
  return convexSolid(randomConvexShape(rng, type), randomPlace(rng, spread));
}

using TypePair = std::pair<ShapeType, ShapeType>;

std::string nameOf(const testing::TestParamInfo<TypePair>& info) {
  std::string name;
  for (const ShapeType type : {info.param.first, info.param.second}) name += std::string(toString(type));
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
}

class ConvexPair : public testing::TestWithParam<TypePair> {};

TEST_P(ConvexPair, IsProvenByPlanesAndHulls) {
  Rng rng(61);
  int overlaps = 0;
  for (int i = 0; i < kPairs && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double spread = i % 2 == 0 ? 0.15 : 0.6;
    const ConvexSolid a = randomSolid(rng, GetParam().first, spread);
    const ConvexSolid b = randomSolid(rng, GetParam().second, spread);
    overlaps += expectProven(a, b, rng);
  }
  EXPECT_GT(overlaps, kPairs / 30);
  EXPECT_LT(overlaps, kPairs * 4 / 5);
}

TEST_P(ConvexPair, IsTheSameFromBothSidesAndEverywhere) {
  Rng rng(62);
  for (int i = 0; i < kPairs / 10 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const ConvexSolid a = randomSolid(rng, GetParam().first, 0.3),
                      b = randomSolid(rng, GetParam().second, 0.3);
    const Proximity ab = between(a, b), ba = between(b, a);
    const double tolerance = ab.distance + a.sweep + b.sweep > 0 ? 1e-9 : 1e-6;
    EXPECT_NEAR(ab.distance, ba.distance, tolerance);
    const Pose X_VW = randomPlace(rng, 100);
    const Proximity moved = convexProximity(a.shape, X_VW * a.X_W, b.shape, X_VW * b.X_W);
    EXPECT_NEAR(ab.distance, moved.distance, tolerance);
  }
}

// Same places, touching faces, edges and corners, flat boxes, needles and points, meshes in a plane.
TEST_P(ConvexPair, StaysSoundWhereShapesDegenerate) {
  Rng rng(63);
  const double lengths[] = {0, 0.1, 0.2, 0.3, 0.4, 1e-13, 1e-9};
  const auto length = [&] { return lengths[rng.index(7)]; };
  const auto place = [&] { return Vector3d(length(), length(), length()); };
  const auto solid = [&](ShapeType type, int i) {
    Shape shape{.type = type, .extent = 2 * place(), .radius = length()};
    if (type == ShapeType::kRoundedBox) shape.radius = 0, shape.extent.array() += 0.1;
    if (type == ShapeType::kCylinder || type == ShapeType::kCone) shape.radius += 0.1;
    if (usesMesh(type)) {
      std::vector<Eigen::Vector3f> points;
      for (int k = 1 + rng.index(8); k > 0; --k) points.push_back(place().cast<float>());
      shape.mesh = TriangleMesh(points, {}, {});
    }
    Pose X(translation(length(), length(), length()));
    if (i % 2 == 1) X.R = rotationFromRollPitchYaw(place() * 10 * M_PI_4);
    return convexSolid(shape, X);
  };
  for (int i = 0; i < kPairs / 2 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const ConvexSolid a = solid(GetParam().first, 0), b = solid(GetParam().second, i);
    const CertifiedProximity certified = certifiedProximity(a.shape, a.X_W, b.shape, b.X_W);
    const Proximity& found = certified.proximity;
    ASSERT_TRUE(found.p_WA.allFinite() && found.p_WB.allFinite() && found.normal_W.allFinite());
    EXPECT_NEAR(found.normal_W.norm(), 1, 1e-14);
    EXPECT_LE((found.p_WA - found.p_WB - found.distance * found.normal_W).norm(), 1e-14);
    const double gap = found.distance + a.sweep + b.sweep;
    // Squares of distances tell directions apart to half of the digits.
    EXPECT_NEAR(gap, width(a, b, found.normal_W), gap > 0 ? 1e-8 : 1e-12);
    if (isCurved(a) || isCurved(b)) {
      EXPECT_LE(widestBySearch(a, b, found.normal_W, rng), gap + 1e-6);
    } else {
      EXPECT_LE(certified.slack, 1e-8);
    }
  }
}

constexpr ShapeType kBox = ShapeType::kBox, kSphere = ShapeType::kSphere, kCapsule = ShapeType::kCapsule,
                    kRounded = ShapeType::kRoundedBox, kCylinder = ShapeType::kCylinder,
                    kCone = ShapeType::kCone, kMesh = ShapeType::kMesh, kCloud = ShapeType::kPointCloud,
                    kSwept = ShapeType::kSphereSweptConvex, kEllipsoid = ShapeType::kEllipsoid;

INSTANTIATE_TEST_SUITE_P(
    All, ConvexPair,
    testing::Values(TypePair{kCylinder, kBox}, TypePair{kCylinder, kSphere}, TypePair{kCylinder, kCapsule},
                    TypePair{kRounded, kCylinder}, TypePair{kCylinder, kCylinder}, TypePair{kMesh, kBox},
                    TypePair{kSphere, kMesh}, TypePair{kMesh, kCapsule}, TypePair{kMesh, kRounded},
                    TypePair{kMesh, kCylinder}, TypePair{kMesh, kMesh}, TypePair{kBox, kCloud},
                    TypePair{kCloud, kSphere}, TypePair{kCloud, kCapsule}, TypePair{kCloud, kRounded},
                    TypePair{kCylinder, kCloud}, TypePair{kCloud, kMesh}, TypePair{kCloud, kCloud},
                    TypePair{kSwept, kBox}, TypePair{kSwept, kSphere}, TypePair{kCapsule, kSwept},
                    TypePair{kSwept, kRounded}, TypePair{kSwept, kCylinder}, TypePair{kSwept, kMesh},
                    TypePair{kSwept, kCloud}, TypePair{kSwept, kSwept}, TypePair{kCone, kBox},
                    TypePair{kCone, kSphere}, TypePair{kCapsule, kCone}, TypePair{kCone, kRounded},
                    TypePair{kCone, kCylinder}, TypePair{kCone, kCone}, TypePair{kCone, kMesh},
                    TypePair{kCloud, kCone}, TypePair{kSwept, kCone}, TypePair{kEllipsoid, kBox},
                    TypePair{kEllipsoid, kSphere}, TypePair{kCapsule, kEllipsoid},
                    TypePair{kEllipsoid, kCylinder}, TypePair{kEllipsoid, kEllipsoid},
                    TypePair{kMesh, kEllipsoid}),
    nameOf);

// Pairs that proximity() measures by formulas.
class FormulaPair : public testing::TestWithParam<TypePair> {};

TEST_P(FormulaPair, AgreesWithTheFormula) {
  Rng rng(64);
  for (int i = 0; i < kPairs && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const ConvexSolid a = randomSolid(rng, GetParam().first, 0.3),
                      b = randomSolid(rng, GetParam().second, 0.3);
    EXPECT_NEAR(between(a, b).distance, proximity(a.shape, a.X_W, b.shape, b.X_W).distance, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FormulaPair,
                         testing::Values(TypePair{kBox, kBox}, TypePair{kBox, kSphere},
                                         TypePair{kBox, kCapsule}, TypePair{kBox, kRounded},
                                         TypePair{kSphere, kCapsule}, TypePair{kCapsule, kCapsule},
                                         TypePair{kRounded, kCapsule}, TypePair{kRounded, kRounded}),
                         nameOf);

Shape cylinder(double radius, double length) {
  return {.type = kCylinder, .extent = {0, 0, length}, .radius = radius};
}
Shape sphere(double radius) { return {.type = kSphere, .radius = radius}; }
Shape box(double x, double y, double z) { return {.type = kBox, .extent = {x, y, z}}; }

TEST(ConvexDistance, MeasuresBallsFromCylindersAsTheFormulaDoes) {
  Rng rng(65);
  for (int i = 0; i < kPairs; ++i) {
    const double radius = rng.uniform(0.1, 0.5), length = rng.uniform(0.2, 2);
    const Vector3d p = rng.normalVector(3) / 2;
    const double side = p.head<2>().norm() - radius, cap = std::abs(p.z()) - length / 2;
    const double apart = std::hypot(std::max(side, 0.), std::max(cap, 0.));
    const double exact = apart > 0 ? apart : std::max(side, cap);
    EXPECT_NEAR(
        proximity(cylinder(radius, length), {}, sphere(0.05), {Eigen::Matrix3d::Identity(), p}).distance,
        exact - 0.05, apart > 0 ? 1e-9 : 1e-6)
        << i;
  }
}

// Thousands of ways out are nearly as short as the shortest.
TEST(ConvexDistance, FindsTheWayOutOfCylindersAroundOneAxis) {
  const Shape rod = cylinder(0.5, 5);
  for (const double aside : {0., 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    EXPECT_NEAR(proximity(rod, {}, rod, translation(0, aside, 0)).distance, aside - 1, 1e-7) << aside;
    EXPECT_NEAR(proximity(rod, {}, sphere(0.1), translation(aside, 0, 0)).distance, aside - 0.6, 1e-7)
        << aside;
    // Tilted about x, the shortest way stays the one along x.
    const CertifiedProximity tilted =
        certifiedProximity(rod, {}, rod, rotation(aside, {1, 0, 0}) * translation(aside, 0, 0));
    EXPECT_NEAR(tilted.proximity.distance, aside - 1, 1e-7) << aside;
    EXPECT_LE(tilted.slack, 5e-7) << aside;
  }
  EXPECT_DOUBLE_EQ(proximity(cylinder(1, 0.5), {}, cylinder(1, 0.5), {}).distance, -0.5);
}

TEST(ConvexDistance, IsContinuousWhereShapesTouch) {
  const Pose X_WA = rotation(0.7, {1, 2, 3});
  for (const double gap : {1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12, 0., -1e-12, -1e-9, -1e-7, -1e-5, -1e-3}) {
    SCOPED_TRACE(gap);
    const double tolerance = gap > 0 ? 1e-9 : 1e-6;
    const Proximity faces =
        convexProximity(box(1, 1, 1), X_WA, box(1, 1, 1), X_WA * translation(0.3, 1 + gap, 0.2));
    EXPECT_NEAR(faces.distance, gap, 1e-14);
    EXPECT_LE((faces.normal_W + X_WA.R.col(1)).norm(), 1e-9);
    const Proximity caps =
        proximity(cylinder(0.3, 1), X_WA, cylinder(0.4, 1), X_WA * translation(0.1, 0, 1 + gap));
    EXPECT_NEAR(caps.distance, gap, 1e-10);
    EXPECT_LE((caps.normal_W + X_WA.R.col(2)).norm(), 1e-9);
    const Proximity sides = proximity(cylinder(0.3, 1), {}, cylinder(0.4, 1),
                                      translation(0.7 + gap, 0, 0) * rotation(1, {1, 0, 0}));
    EXPECT_NEAR(sides.distance, gap, tolerance);
    EXPECT_LE((sides.normal_W + Vector3d::UnitX()).norm(), 1e-5);
  }
}

TEST(ConvexDistance, KnowsFlatThings) {
  const Shape square = pointsShape({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  const Shape needle = pointsShape({{0, 0, -1}, {0, 0, 1}}), point = pointsShape({{0, 0, 0}});
  EXPECT_EQ(proximity(point, {}, point, {}).distance, 0);
  EXPECT_EQ(proximity(point, {}, sphere(0.25), {}).distance, -0.25);
  EXPECT_EQ(proximity(needle, {}, needle, {}).distance, 0);
  EXPECT_EQ(proximity(square, {}, square, {}).distance, 0);
  EXPECT_NEAR(std::abs(proximity(square, {}, square, {}).normal_W.z()), 1, 1e-15);
  EXPECT_DOUBLE_EQ(proximity(square, {}, needle, {}).distance, -1);
  EXPECT_DOUBLE_EQ(proximity(square, {}, needle, translation(0.75, 0.5, 0)).distance, -0.25);
  EXPECT_DOUBLE_EQ(proximity(square, {}, point, translation(0.3, 0.2, 0.5)).distance, 0.5);
}

TEST(ConvexDistance, TakesAMeshWithoutHullByItsPoints) {
  Rng rng(66);
  Shape mesh = randomConvexShape(rng, kMesh, 40);
  const Pose X_WB = translation(0.1, 0.2, 0.3);
  const double withHull = proximity(mesh, {}, box(0.2, 0.2, 0.2), X_WB).distance;
  mesh.hull = {};
  EXPECT_DOUBLE_EQ(proximity(mesh, {}, box(0.2, 0.2, 0.2), X_WB).distance, withHull);
}

// Random points on a unit ball, each with its opposite, so that the ball minus itself is the ball twice as
// large.
Shape meshBall(Rng& rng, int pairs) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < pairs; ++i) {
    points.push_back(Vector3d(rng.normalVector(3)).normalized().cast<float>());
    points.push_back(-points.back());
  }
  Shape shape = pointsShape(points);
  shape.hull = convexHull(shape.mesh);
  return shape;
}

// A ball of 2000 corners, with 4000 faces that are almost as near to its middle as the nearest.
TEST(ConvexDistance, FindsTheNearestFaceOfManyAlike) {
  Rng rng(67);
  const ConvexSolid ball = convexSolid(meshBall(rng, 1000), {});
  for (const double aside : {0., 1e-6, 1e-3, 0.1}) {
    SCOPED_TRACE(aside);
    const Vector3d p(aside, 0, 0);
    const Pose X_WB{Eigen::Matrix3d::Identity(), p};
    EXPECT_NEAR(proximity(ball.shape, {}, sphere(0), X_WB).distance, ball.outside(p), 1e-9);
    const CertifiedProximity twoBalls = certifiedProximity(ball.shape, {}, ball.shape, X_WB);
    EXPECT_NEAR(twoBalls.proximity.distance, 2 * ball.outside(p / 2), 1e-9);
    EXPECT_LE(twoBalls.slack, 1e-10);
  }
}

// Turned, so that also pairs of edges make faces of the difference.
TEST(ConvexDistance, FindsTheWayOutOfMeshesAroundOneMiddle) {
  Rng rng(68);
  for (const double aside : {0., 1e-8, 1e-6, 1e-3, 0.1, 0.5}) {
    SCOPED_TRACE(aside);
    const Pose X_WB{expSO3(rng.normalVector(3)), aside * Vector3d(rng.normalVector(3)).normalized()};
    const ConvexSolid a = convexSolid(meshBall(rng, 100), {}), b = convexSolid(meshBall(rng, 80), X_WB);
    const Proximity ab = between(a, b);
    expectSound(a, b, ab, 1e-9);
    EXPECT_NEAR(ab.distance, widestByHull(a, b), 1e-9);
    EXPECT_NEAR(ab.distance, between(b, a).distance, 1e-12);
  }
}

}  // namespace rex::convex_distance_test
