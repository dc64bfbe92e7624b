#include "grasping/object_surface.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/welded_mesh.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"

namespace rex::object_surface_test {

using Eigen::Vector3d;
using std::numbers::pi;

struct Body {
  Shape shape;
  std::function<bool(const Vector3d&)> isInside;
  double area, volume;
};

Shape meshShape(const BareMesh& mesh) {
  return {.type = ShapeType::kMesh, .mesh = weldedMesh(mesh.positions, mesh.triangles)};
}

std::vector<Body> bodies() {
  const double r = 0.3, l = 0.8;
  return {
      {{.type = ShapeType::kBox, .extent = {1, 0.5, 0.2}},
       [](const Vector3d& p) { return (p.cwiseAbs() - Vector3d(0.5, 0.25, 0.1)).maxCoeff() < 0; },
       1.6,
       0.1},
      {{.type = ShapeType::kSphere, .radius = r},
       [=](const Vector3d& p) { return p.norm() < r; },
       4 * pi * r * r,
       4 * pi * r * r * r / 3},
      {{.type = ShapeType::kCapsule, .extent = {0, 0, l}, .radius = r},
       [=](const Vector3d& p) { return (p - Vector3d(0, 0, std::clamp(p.z(), -l / 2, l / 2))).norm() < r; },
       4 * pi * r * r + 2 * pi * r * l,
       4 * pi * r * r * r / 3 + pi * r * r * l},
      {{.type = ShapeType::kCylinder, .extent = {0, 0, l}, .radius = r},
       [=](const Vector3d& p) { return p.head<2>().norm() < r && std::abs(p.z()) < l / 2; },
       2 * pi * r * r + 2 * pi * r * l,
       pi * r * r * l},
      {{.type = ShapeType::kCone, .extent = {0, 0, l}, .radius = r},
       [=](const Vector3d& p) { return p.z() > -l / 2 && p.head<2>().norm() < r * (0.5 - p.z() / l); },
       pi * r * r + pi * r * std::hypot(r, l),
       pi * r * r * l / 3},
      {meshShape(cubeSample(0.25f)), [](const Vector3d& p) { return p.cwiseAbs().maxCoeff() < 0.25; }, 1.5,
       0.125}};
}

TEST(ObjectSurface, IsMetWhereALineGoesInAndOut) {
  Rng rng(51);
  for (const Body& body : bodies()) {
    const ObjectSurface surface(body.shape);
    int met = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      const Vector3d start = rng.uniformVector(3, -0.7, 0.7);
      const Vector3d along = rng.normalVector(3).normalized();
      const std::vector<LineHit> hits = surface.hits(start, along);
      met += !hits.empty();
      for (const LineHit& hit : hits) {
        const Vector3d p = start + hit.t * along;
        EXPECT_NEAR(hit.normal_O.norm(), 1, 1e-12);
        EXPECT_FALSE(body.isInside(p + 1e-6 * hit.normal_O));
        EXPECT_TRUE(body.isInside(p - 1e-6 * hit.normal_O));
      }
      for (int k = 0; k < 20; ++k) {
        const double t = rng.uniform(-1.5, 1.5);
        const auto before =
            std::count_if(hits.begin(), hits.end(), [&](const LineHit& h) { return h.t < t; });
        EXPECT_EQ(before % 2 == 1, body.isInside(start + t * along)) << toString(body.shape.type);
      }
    }
    EXPECT_GT(met, 100);
  }
}

// The flux of p through a closed surface is three times its volume, that of a constant zero.
TEST(ObjectSurface, IsSampledEvenly) {
  Rng rng(52);
  for (const Body& body : bodies()) {
    const ObjectSurface surface(body.shape);
    EXPECT_NEAR(surface.area(), body.area, 1e-7);
    const int count = 40'000;
    double flux = 0;
    Vector3d constant = Vector3d::Zero(), weighted = Vector3d::Zero();
    for (const SurfacePoint& point : surface.sample(rng, count)) {
      EXPECT_FALSE(body.isInside(point.p_OQ + 1e-6 * point.normal_O));
      EXPECT_TRUE(body.isInside(point.p_OQ - 1e-6 * point.normal_O));
      flux += point.p_OQ.dot(point.normal_O);
      constant += point.normal_O;
      weighted += point.p_OQ.cwiseProduct(point.normal_O);
    }
    // Four standard deviations: no summand is larger than one.
    const double tolerance = 4 * surface.area() / std::sqrt(count);
    EXPECT_NEAR(flux * surface.area() / count, 3 * body.volume, tolerance);
    EXPECT_LT((constant * surface.area() / count).norm(), 2 * tolerance);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(weighted[axis] * surface.area() / count, body.volume, tolerance / 2);
  }
}

TEST(ObjectSurface, GivesTheSamePointsForTheSameSeed) {
  const ObjectSurface surface(bodies()[0].shape);
  Rng a(1), b(1);
  const auto first = surface.sample(a, 10), second = surface.sample(b, 10);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(first[k].p_OQ, second[k].p_OQ);
  EXPECT_TRUE(surface.sample(a, 0).empty());
}

TEST(ObjectSurface, RefusesWhatHasNone) {
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kMarker}), "surface of a shape: found marker");
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kBox, .extent = {1, 0, 1}}),
                   "surface: edge of the box: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kSphere, .radius = HUGE_VAL}),
                   "surface: radius of the sphere: found inf");
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kCylinder, .extent = {0, 0, 0}, .radius = 1}),
                   "surface: length of the cylinder: found 0");
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kCone, .extent = {0, 0, 0}, .radius = 1}),
                   "surface: length of the cone: found 0");
  EXPECT_REX_ERROR(ObjectSurface({.type = ShapeType::kMesh}), "surface of a mesh: found 0 triangles");
  const ObjectSurface ball({.type = ShapeType::kCapsule, .extent = {0, 0, 0}, .radius = 1});
  EXPECT_NEAR(ball.area(), 4 * pi, 1e-12);
  Rng rng(1);
  EXPECT_REX_ERROR(ball.sample(rng, -1), "surface: number of points: found -1, wanted 0 or more");
  EXPECT_REX_ERROR(ball.hits({0, 0, 0}, {0, 2, 0}), "surface: length of the direction: found 2, wanted 1");
  EXPECT_REX_ERROR(ball.hits({HUGE_VAL, 0, 0}, {0, 1, 0}), "surface: start of the line: number 0: found inf");
  EXPECT_REX_ERROR(ball.hits({0, 0, 0}, {0, 1, std::nan("")}), "surface: direction of the line: number 2");
}

}  // namespace rex::object_surface_test
