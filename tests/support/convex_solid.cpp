#include "support/convex_solid.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "geometry/convex_hull.h"

namespace rex {

using Eigen::Vector3d;

namespace {

Vector3d coreHalf(const Shape& shape) {
  if (shape.type == ShapeType::kSphere) return Vector3d::Zero();
  if (shape.type == ShapeType::kCapsule || shape.type == ShapeType::kCylinder)
    return {0, 0, shape.extent.z() / 2};
  return (shape.extent / 2).array() - (shape.type == ShapeType::kRoundedBox ? shape.radius : 0);
}

std::vector<Vector3d> cornersOf(const Shape& shape, const Pose& X_W) {
  std::vector<Vector3d> corners;
  if (usesMesh(shape.type)) {
    for (const Eigen::Vector3f& p : shape.mesh.positions()) corners.push_back(X_W * p.cast<double>());
    return corners;
  }
  if (shape.type == ShapeType::kCone)
    return {X_W * Vector3d(0, 0, shape.extent.z() / 2), X_W * Vector3d(0, 0, -shape.extent.z() / 2)};
  corners.push_back(X_W.p);
  if (shape.type == ShapeType::kEllipsoid) return corners;
  const Vector3d half = coreHalf(shape);
  for (int k = 0; k < 3; ++k) {
    if (half[k] == 0) continue;
    for (std::size_t i = corners.size(); i-- > 0;) {
      corners.push_back(corners[i] - half[k] * X_W.R.col(k));
      corners[i] += half[k] * X_W.R.col(k);
    }
  }
  return corners;
}

}  // namespace

double ConvexSolid::least(const Vector3d& n) const {
  double value = std::numeric_limits<double>::infinity();
  const double rim = disc * n.cross(X_W.R.col(2)).norm();
  if (shape.type == ShapeType::kCone) return std::min(n.dot(corners_W[0]), n.dot(corners_W[1]) - rim);
  for (const Vector3d& p : corners_W) value = std::min(value, n.dot(p));
  if (shape.type == ShapeType::kEllipsoid)
    return value - (X_W.R.transpose() * n).cwiseProduct(shape.extent / 2).norm();
  return value - rim;
}

double ConvexSolid::outside(const Vector3d& p_W) const {
  if (usesMesh(shape.type)) return (planes_W.leftCols<3>() * p_W - planes_W.col(3)).maxCoeff();
  const Vector3d p = X_W.inverse() * p_W, half = coreHalf(shape);
  if (shape.type == ShapeType::kCone) {
    const Eigen::Vector2d across = Eigen::Vector2d(shape.extent.z(), disc).normalized();
    const double side = across.dot(Eigen::Vector2d(p.head<2>().norm(), p.z() - shape.extent.z() / 2));
    return std::max(side, -shape.extent.z() / 2 - p.z());
  }
  if (shape.type == ShapeType::kEllipsoid) return (p.cwiseQuotient(half).norm() - 1) * half.minCoeff();
  if (disc > 0) return std::max(p.head<2>().norm() - disc, std::abs(p.z()) - half.z());
  return (p.cwiseAbs() - half).maxCoeff();
}

ConvexSolid convexSolid(const Shape& shape, const Pose& X_W) {
  ConvexSolid solid{shape, X_W, 0, 0, cornersOf(shape, X_W), {}};
  if (shape.type == ShapeType::kCylinder || shape.type == ShapeType::kCone) {
    solid.disc = shape.radius;
  } else if (shape.type == ShapeType::kSphere || shape.type == ShapeType::kCapsule ||
             shape.type == ShapeType::kRoundedBox || shape.type == ShapeType::kSphereSweptConvex) {
    solid.sweep = shape.radius;
  }
  const std::span triangles = shape.hull.triangles();
  solid.planes_W.resize(static_cast<long>(triangles.size()), 4);
  for (long i = 0; const auto& [a, b, c] : triangles) {
    const auto corner = [&](std::uint32_t k) -> Vector3d {
      return X_W * shape.hull.positions()[k].cast<double>();
    };
    const Vector3d n = (corner(b) - corner(a)).cross(corner(c) - corner(a)).normalized();
    solid.planes_W.row(i++) << n.transpose(), n.dot(corner(a));
  }
  return solid;
}

Shape pointsShape(const std::vector<Eigen::Vector3f>& points) {
  return {.type = ShapeType::kMesh, .mesh = TriangleMesh(points, {}, {})};
}

Shape randomConvexShape(Rng& rng, ShapeType type, int corners) {
  Shape shape{.type = type, .extent = rng.uniformVector(3, 0.05, 0.6), .radius = rng.uniform(0.02, 0.3)};
  if (type == ShapeType::kRoundedBox) shape.radius = shape.extent.minCoeff() * rng.uniform(0.1, 0.45);
  if (!usesMesh(type)) return shape;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < corners; ++i) {
    const Vector3d direction = Vector3d(rng.normalVector(3)).normalized();
    points.push_back(direction.cwiseProduct(shape.extent / 2).cast<float>());
  }
  shape.mesh = TriangleMesh(points, {}, {});
  shape.hull = convexHull(shape.mesh);
  return shape;
}

}  // namespace rex
