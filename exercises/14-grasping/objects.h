#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "exercise.h"
#include "geometry/convex_hull.h"
#include "grasping/object_surface.h"

// Objects that the checks draw at random, and fingers on them.

/// A polygon, counter-clockwise, with the centroid of its area, and how far it reaches from there.
struct Plate {
  std::vector<Eigen::Vector2d> corners;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double length = 0;
};

inline Plate plateOf(const std::vector<Eigen::Vector2d>& corners) {
  Plate plate{corners, Eigen::Vector2d::Zero(), 0};
  double twiceArea = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double part = a.x() * b.y() - a.y() * b.x();
    twiceArea += part;
    plate.center += part / 3 * (a + b);
  }
  plate.center /= twiceArea;
  for (const Eigen::Vector2d& corner : corners)
    plate.length = std::max(plate.length, (corner - plate.center).norm());
  return plate;
}

/// A polygon with 4 to 8 random corners, 8 to 20 cm across, often concave; edges are 15 mm long or more.
inline Plate randomPlate(rex::Rng& rng) {
  for (;;) {
    const int n = 4 + rng.index(5);
    const double radius = rng.uniform(0.04, 0.1), turn = rng.uniform(0, 6);
    const Eigen::Vector2d at(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3));
    std::vector<Eigen::Vector2d> corners;
    for (int i = 0; i < n; ++i) {
      const double angle = turn + 2 * std::numbers::pi / n * (i + rng.uniform(-0.25, 0.25));
      corners.push_back(at +
                        radius * rng.uniform(0.55, 1) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    double shortest = radius;
    for (std::size_t i = 0; i < corners.size(); ++i)
      shortest = std::min(shortest, (corners[(i + 1) % corners.size()] - corners[i]).norm());
    if (shortest > 0.015) return plateOf(corners);
  }
}

inline std::vector<Eigen::Vector2d> rotatedBy(double turn, std::vector<Eigen::Vector2d> corners) {
  for (Eigen::Vector2d& corner : corners)
    corner = Eigen::Vector2d(std::cos(turn) * corner.x() - std::sin(turn) * corner.y(),
                             std::sin(turn) * corner.x() + std::cos(turn) * corner.y());
  return corners;
}

/// A V whose centroid lies in its opening: the normals of two of its four sides point away from it.
inline Plate randomWings(rex::Rng& rng) {
  const double reach = rng.uniform(0.05, 0.08), height = rng.uniform(0.09, 0.12),
               middle = rng.uniform(0.02, 0.03);
  return plateOf(rotatedBy(rng.uniform(0, 6), {{0, 0}, {reach, height}, {0, middle}, {-reach, height}}));
}

/// A U whose centroid lies in its opening or near it: the normals of the opening's sides point away from it.
inline Plate randomFork(rex::Rng& rng) {
  const double width = rng.uniform(0.08, 0.12), height = rng.uniform(0.08, 0.12),
               bar = rng.uniform(0.018, 0.025);
  const double turn = rng.uniform(0, 6);
  return plateOf(rotatedBy(turn, {{0, 0},
                                  {width, 0},
                                  {width, height},
                                  {width - bar, height},
                                  {width - bar, bar},
                                  {bar, bar},
                                  {bar, height},
                                  {0, height}}));
}

/// A finger at a random position on the edges of a plate.
inline PlanarFinger fingerOn(const Plate& plate, double friction, rex::Rng& rng) {
  const auto i = static_cast<std::size_t>(rng.index(static_cast<int>(plate.corners.size())));
  const Eigen::Vector2d &a = plate.corners[i], &b = plate.corners[(i + 1) % plate.corners.size()];
  const Eigen::Vector2d side = (b - a).normalized();
  return {a + rng.uniform(0.05, 0.95) * (b - a), {-side.y(), side.x()}, friction};
}

/// A box, a cylinder, or the hull of some points.
inline rex::ObjectSurface randomSolid(rex::Rng& rng) {
  rex::Shape shape;
  shape.extent = rng.uniformVector(3, 0.04, 0.15);
  shape.radius = rng.uniform(0.02, 0.06);
  const int kind = rng.index(3);
  if (kind == 1) shape.type = rex::ShapeType::kCylinder;
  if (kind == 2) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 20; ++i)
      points.push_back(rng.normalVector(3).normalized().cwiseProduct(shape.extent).cast<float>());
    shape.type = rex::ShapeType::kMesh;
    shape.mesh = rex::convexHull(points);
  }
  return rex::ObjectSurface(shape);
}

inline std::vector<Finger> fingersOn(const rex::ObjectSurface& solid, int count, double friction,
                                     rex::Rng& rng) {
  std::vector<Finger> fingers;
  for (const rex::SurfacePoint& point : solid.sample(rng, count))
    fingers.push_back({point.p_OQ, -point.normal_O, friction});
  return fingers;
}

/// A unit vector in d dimensions, evenly over all directions.
inline Eigen::VectorXd randomDirection(rex::Rng& rng, int d) { return rng.normalVector(d).normalized(); }

inline Finger randomFinger(rex::Rng& rng, double friction) {
  return {rng.uniformVector(3, -0.5, 0.5), randomDirection(rng, 3), friction};
}

inline PlanarFinger randomPlanarFinger(rex::Rng& rng, double friction) {
  return {rng.uniformVector(2, -0.5, 0.5), randomDirection(rng, 2), friction};
}
