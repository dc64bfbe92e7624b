// The second opinion knows cores by their corners only. Apart: two planes through the nearest points hold the
// cores away from each other, which proves the distance. In overlap: the hull of the differences of all
// corners, by qhull.
#include "collision/proximity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"
#include "support/hull_depth.h"

namespace rex::proximity_test {

using Eigen::Vector3d;

struct Placed {
  Shape shape{};
  Pose X_W{};
};

Shape box(double x, double y, double z) { return {.type = ShapeType::kBox, .extent = {x, y, z}}; }
Shape sphere(double radius) { return {.type = ShapeType::kSphere, .radius = radius}; }
Shape capsule(double length, double radius) {
  return {.type = ShapeType::kCapsule, .extent = {0, 0, length}, .radius = radius};
}
Shape roundedBox(double x, double y, double z, double radius) {
  return {.type = ShapeType::kRoundedBox, .extent = {x, y, z}, .radius = radius};
}

Vector3d coreHalf(const Shape& shape) {
  if (shape.type == ShapeType::kSphere) return Vector3d::Zero();
  if (shape.type == ShapeType::kCapsule) return {0, 0, shape.extent.z() / 2};
  return (shape.extent / 2).array() - (shape.type == ShapeType::kRoundedBox ? shape.radius : 0);
}
double sweep(const Shape& shape) { return shape.type == ShapeType::kBox ? 0 : shape.radius; }

// Corners of the core in W; those that coincide, once.
std::vector<Vector3d> corners(const Placed& solid) {
  const Vector3d half = coreHalf(solid.shape);
  std::vector<Vector3d> all{solid.X_W.p};
  for (int i = 0; i < 3; ++i) {
    if (half[i] == 0) continue;
    std::vector<Vector3d> both;
    for (const Vector3d& p : all)
      for (const double side : {-half[i], half[i]}) both.push_back(p + side * solid.X_W.R.col(i));
    all = both;
  }
  return all;
}

double least(const Vector3d& direction, const std::vector<Vector3d>& points) {
  double value = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) value = std::min(value, direction.dot(p));
  return value;
}

double distanceFromCore(const Placed& solid, const Vector3d& p_W) {
  const Vector3d p = solid.X_W.inverse() * p_W, half = coreHalf(solid.shape);
  return (p - p.cwiseMax(-half).cwiseMin(half)).norm();
}

// How far apart the cores are: exact where they overlap, else -infinity.
double overlapOfCores(const Placed& a, const Placed& b) {
  std::vector<Vector3d> differences;
  for (const Vector3d& p : corners(a))
    for (const Vector3d& q : corners(b)) differences.push_back(p - q);
  if (differences.size() < 8) return -std::numeric_limits<double>::infinity();  // flat, so never inside
  return -hullDepth(differences);
}

// Of points that nearly touch, the difference has few digits left to tell the direction.
double directionTolerance(double gap) { return gap > 0 ? 1e-15 / gap : 0; }

void expectExact(const Placed& a, const Placed& b, double tolerance = 1e-12, double tolerance_p = 1e-12) {
  const Proximity found = proximity(a.shape, a.X_W, b.shape, b.X_W);
  const double sweepA = sweep(a.shape), sweepB = sweep(b.shape);
  EXPECT_NEAR(found.normal_W.norm(), 1, tolerance);
  EXPECT_LE((found.p_WA - found.p_WB - found.distance * found.normal_W).norm(), tolerance);
  // Never less than this width, in any direction.
  const double width = least(found.normal_W, corners(a)) + least(-found.normal_W, corners(b));
  const double gap = found.distance + sweepA + sweepB;
  EXPECT_NEAR(gap, width, tolerance + directionTolerance(gap));
  // The nearest points lie on the solids.
  EXPECT_LE(distanceFromCore(a, found.p_WA + sweepA * found.normal_W), tolerance_p);
  EXPECT_LE(distanceFromCore(b, found.p_WB - sweepB * found.normal_W), tolerance_p);
  // Never more: the points prove it for cores apart, the hull for others.
  if (gap < -1e-9) {
    EXPECT_NEAR(gap, overlapOfCores(a, b), 1e-10);
  }
}

Shape randomShape(Rng& rng, ShapeType type) {
  const Vector3d size = rng.uniformVector(3, 0.05, 0.6);
  if (type == ShapeType::kSphere) return sphere(size.x());
  if (type == ShapeType::kCapsule) return capsule(size.z(), size.x() / 3);
  if (type == ShapeType::kRoundedBox) return roundedBox(size.x(), size.y(), size.z(), size.minCoeff() / 4);
  return box(size.x(), size.y(), size.z());
}

// Every third one stands along the axes, so that edges and faces are parallel.
Pose randomPlace(Rng& rng, double spread) {
  Pose X{expSO3(2 * rng.normalVector(3)), rng.uniformVector(3, -spread, spread)};
  if (rng.index(3) == 0) X.R = rotationFromRollPitchYaw(Vector3d(rng.index(4), 0, rng.index(4)) * M_PI_2);
  return X;
}

using TypePair = std::pair<ShapeType, ShapeType>;
class ExactPair : public testing::TestWithParam<TypePair> {};

TEST_P(ExactPair, AgreesWithPlanesAndHulls) {
  Rng rng(51);
  int overlaps = 0;
  for (int i = 0; i < 10000 && !HasFailure(); ++i) {
    const double spread = i % 2 == 0 ? 0.2 : 0.8;
    const Placed a{randomShape(rng, GetParam().first), randomPlace(rng, spread)};
    const Placed b{randomShape(rng, GetParam().second), randomPlace(rng, spread)};
    SCOPED_TRACE(i);
    expectExact(a, b);
    overlaps += proximity(a.shape, a.X_W, b.shape, b.X_W).distance < 0;
  }
  EXPECT_GT(overlaps, 2000);
  EXPECT_LT(overlaps, 8000);
}

TEST_P(ExactPair, IsTheSameFromBothSidesAndEverywhere) {
  Rng rng(52);
  for (int i = 0; i < 1000 && !HasFailure(); ++i) {
    const Placed a{randomShape(rng, GetParam().first),
                   {expSO3(rng.normalVector(3)), rng.normalVector(3) / 4}};
    const Placed b{randomShape(rng, GetParam().second),
                   {expSO3(rng.normalVector(3)), rng.normalVector(3) / 4}};
    SCOPED_TRACE(i);
    const Proximity ab = proximity(a.shape, a.X_W, b.shape, b.X_W);
    const Proximity ba = proximity(b.shape, b.X_W, a.shape, a.X_W);
    EXPECT_NEAR(ab.distance, ba.distance, 1e-14);
    EXPECT_LE((ab.p_WA - ba.p_WB).norm() + (ab.p_WB - ba.p_WA).norm(), 1e-11);
    EXPECT_LE((ab.normal_W + ba.normal_W).norm(), 1e-11);
    const Pose X_VW{expSO3(rng.normalVector(3)), rng.normalVector(3)};
    const Proximity moved = proximity(a.shape, X_VW * a.X_W, b.shape, X_VW * b.X_W);
    EXPECT_NEAR(ab.distance, moved.distance, 1e-13);
    EXPECT_LE((X_VW * ab.p_WA - moved.p_WA).norm() + (X_VW * ab.p_WB - moved.p_WB).norm(), 1e-11);
  }
}

// Same places, half overlaps, touching faces, edges and corners, flat boxes and points.
TEST_P(ExactPair, StaysExactWhereShapesDegenerate) {
  Rng rng(53);
  const std::vector<double> places{0, 0.1, 0.2, 0.3, 0.4, 1e-13, 1e-9};
  const auto place = [&] {
    return places[static_cast<std::size_t>(rng.index(static_cast<int>(places.size())))];
  };
  const auto shape = [&](ShapeType type) {
    if (type == ShapeType::kSphere) return sphere(place());
    if (type == ShapeType::kCapsule) return capsule(place(), place());
    if (type == ShapeType::kRoundedBox) return roundedBox(0.4, 0.4, 0.4 + 2 * place(), 0.2);
    return box(2 * place(), 2 * place(), 2 * place());
  };
  for (int i = 0; i < 10000 && !HasFailure(); ++i) {
    const Placed a{shape(GetParam().first), {Eigen::Matrix3d::Identity(), {place(), place(), place()}}};
    Placed b{shape(GetParam().second), {Eigen::Matrix3d::Identity(), {place(), place(), place()}}};
    if (i % 2 == 1) b.X_W.R = rotationFromRollPitchYaw(Vector3d(place(), place(), place()) * 10 * M_PI_4);
    SCOPED_TRACE(i);
    const Proximity found = proximity(a.shape, a.X_W, b.shape, b.X_W);
    const Proximity again = proximity(a.shape, a.X_W, b.shape, b.X_W);
    EXPECT_TRUE(found.p_WA.allFinite() && found.p_WB.allFinite());
    EXPECT_NEAR(found.normal_W.norm(), 1, 1e-14);
    EXPECT_EQ(found.p_WA, again.p_WA);
    const double width = least(found.normal_W, corners(a)) + least(-found.normal_W, corners(b));
    // Where other points are as near, squared distances tell them apart to half of the digits.
    const double gap = found.distance + sweep(a.shape) + sweep(b.shape);
    EXPECT_NEAR(gap, width, gap > 0 ? 1e-8 + directionTolerance(gap) : 1e-12);
    EXPECT_LE((found.p_WA - found.p_WB - found.distance * found.normal_W).norm(), 1e-12);
    EXPECT_LE(distanceFromCore(a, found.p_WA + sweep(a.shape) * found.normal_W), 1e-8);
    EXPECT_LE(distanceFromCore(b, found.p_WB - sweep(b.shape) * found.normal_W), 1e-8);
  }
}

// Edges that are nearly parallel, where inner products lose their digits. Where several directions lead out
// equally far, the points keep half of them.
TEST_P(ExactPair, StaysExactWhereEdgesAreNearlyParallel) {
  Rng rng(54);
  for (int i = 0; i < 5000 && !HasFailure(); ++i) {
    const double angle = std::pow(10., -rng.uniform(0, 16));
    const Placed a{randomShape(rng, GetParam().first), {Eigen::Matrix3d::Identity(), {0, 0, 0}}};
    const Placed b{
        randomShape(rng, GetParam().second),
        {expSO3(angle * rng.normalVector(3)),
         rng.index(2) == 0 ? Vector3d(angle * rng.normalVector(3)) : Vector3d(rng.normalVector(3) / 4)}};
    SCOPED_TRACE(i);
    expectExact(a, b, 3e-12, 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ExactPair,
    testing::Values(
        TypePair{ShapeType::kSphere, ShapeType::kSphere}, TypePair{ShapeType::kSphere, ShapeType::kCapsule},
        TypePair{ShapeType::kSphere, ShapeType::kBox}, TypePair{ShapeType::kCapsule, ShapeType::kSphere},
        TypePair{ShapeType::kCapsule, ShapeType::kCapsule}, TypePair{ShapeType::kCapsule, ShapeType::kBox},
        TypePair{ShapeType::kBox, ShapeType::kSphere}, TypePair{ShapeType::kBox, ShapeType::kCapsule},
        TypePair{ShapeType::kBox, ShapeType::kBox}, TypePair{ShapeType::kRoundedBox, ShapeType::kBox},
        TypePair{ShapeType::kRoundedBox, ShapeType::kRoundedBox}),
    [](const auto& i) {
      std::string name = std::string(toString(i.param.first)) + "And" + std::string(toString(i.param.second));
      std::erase(name, ' ');
      return name;
    });

TEST(Proximity, IsKnownInSimpleCases) {
  const Pose there = translation(0.5, 0, 0);
  const Proximity balls = proximity(sphere(0.1), {}, sphere(0.2), there);
  EXPECT_DOUBLE_EQ(balls.distance, 0.2);
  EXPECT_TRUE(balls.p_WA.isApprox(Vector3d(0.1, 0, 0)));
  EXPECT_TRUE(balls.p_WB.isApprox(Vector3d(0.3, 0, 0)));
  EXPECT_TRUE(balls.normal_W.isApprox(Vector3d(-1, 0, 0)));
  // A capsule's core 0.05 below a face: its ball of 0.1 comes on top.
  const Proximity deep = proximity(capsule(0.2, 0.1), translation(0, 0, 0.55), box(1, 1, 1), {});
  EXPECT_NEAR(deep.distance, -0.15, 1e-15);
  EXPECT_TRUE(deep.normal_W.isApprox(Vector3d(0, 0, 1)));
  EXPECT_DOUBLE_EQ(proximity(box(1, 1, 1), {}, box(1, 1, 1), translation(1.25, 0, 0)).distance, 0.25);
  EXPECT_DOUBLE_EQ(proximity(box(1, 1, 1), {}, box(1, 1, 1), {}).distance, -1);
}

TEST(Proximity, RefusesWhatHasNoVolume) {
  EXPECT_REX_ERROR(proximity({.type = ShapeType::kMarker}, {}, sphere(1), {}),
                   "proximity: found a marker, wanted a solid that can collide");
  EXPECT_REX_ERROR(proximity(sphere(1), {}, {.type = ShapeType::kMesh}, {}),
                   "proximity: found a mesh whose mesh is not loaded, wanted a scene read from a file");
}

}  // namespace rex::proximity_test
