#include <cassert>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/convex_core_internal.h"

namespace rex::internal {

Core coreOf(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kSphere:
      return {CoreType::kSegment, Eigen::Vector3d::Zero(), shape.radius};
    case ShapeType::kCapsule:
      return {CoreType::kSegment, {0, 0, shape.extent.z() / 2}, shape.radius};
    case ShapeType::kBox:
      return {CoreType::kBox, shape.extent / 2, 0};
    case ShapeType::kRoundedBox:
      return {CoreType::kBox, (shape.extent / 2).array() - shape.radius, shape.radius};
    case ShapeType::kCylinder:
    case ShapeType::kCone:
    case ShapeType::kEllipsoid:
    case ShapeType::kMesh:
    case ShapeType::kSphereSweptConvex:
    case ShapeType::kPointCloud:
    case ShapeType::kMarker:
      break;
  }
  return {};
}

void requireSolid(const std::string& what, const Shape& shape) {
  if (shape.type == ShapeType::kMarker)
    throw Error({.what = what, .found = "a marker", .wanted = "a solid that can collide"});
  if (usesMesh(shape.type) && shape.mesh.isEmpty()) {
    throw Error({.what = what,
                 .found = fmt::format("a {} whose mesh is not loaded", toString(shape.type)),
                 .wanted = "a scene read from a file, or loadMeshes()"});
  }
}

using Eigen::Vector3d;

namespace {

// A plain scan: walking from corner to corner would need neighbours, which are not prepared.
Vector3d supportOf(std::span<const Eigen::Vector3f> points, const Vector3d& direction) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double along = points[i].cast<double>().dot(direction); along > most) most = along, best = i;
  return points[best].cast<double>();
}

}  // namespace

ConvexCore::ConvexCore(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kBox:
    case ShapeType::kSphere:
    case ShapeType::kCapsule:
    case ShapeType::kRoundedBox: {
      const Core core = coreOf(shape);
      half_ = core.half;
      radius_ = core.radius;
      break;
    }
    case ShapeType::kCylinder:
    case ShapeType::kCone:
      kind_ = shape.type == ShapeType::kCone ? Kind::kCone : Kind::kCylinder;
      half_ = {shape.radius, shape.radius, shape.extent.z() / 2};
      break;
    case ShapeType::kEllipsoid:
      kind_ = Kind::kEllipsoid;
      half_ = shape.extent / 2;
      break;
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
    case ShapeType::kSphereSweptConvex:
      kind_ = Kind::kPoints;
      // Without a hull, all points give the same result, only more slowly.
      points_ = (shape.hull.isEmpty() ? shape.mesh : shape.hull).positions();
      radius_ = shape.type == ShapeType::kSphereSweptConvex ? shape.radius : 0;
      assert(!points_.empty());
      break;
    case ShapeType::kMarker:
      assert(false);  // see requireSolid()
  }
}

Vector3d ConvexCore::support(const Vector3d& direction) const {
  const auto corner = [&](double x, double y) -> Vector3d {
    return {x, y, std::copysign(half_.z(), direction.z())};
  };
  switch (kind_) {
    case Kind::kPoints:
      return supportOf(points_, direction);
    case Kind::kBox:
      return corner(std::copysign(half_.x(), direction.x()), std::copysign(half_.y(), direction.y()));
    case Kind::kEllipsoid: {
      const Vector3d scaled = half_.cwiseProduct(direction);
      const double length = scaled.norm();
      return length > 0 ? Vector3d(half_.cwiseProduct(scaled) / length) : Vector3d(half_.x(), 0, 0);
    }
    case Kind::kCylinder:
    case Kind::kCone:
      break;
  }
  const double across = std::hypot(direction.x(), direction.y());
  // Exactly along the axis, all points of the cap are equally far; its centre is as good as any other.
  const double scale = across > 0 ? half_.x() / across : 0;
  const Vector3d onRim = corner(scale * direction.x(), scale * direction.y());
  if (kind_ == Kind::kCylinder) return onRim;
  const bool isTip = 2 * half_.z() * direction.z() > half_.x() * across;
  return isTip ? Vector3d(0, 0, half_.z()) : Vector3d(onRim.x(), onRim.y(), -half_.z());
}

}  // namespace rex::internal
