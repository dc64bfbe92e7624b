#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/convex_core_internal.h"

namespace rex::internal {

using Eigen::Vector3d;

namespace {

std::span<const Eigen::Vector3f> cornersOf(const Shape& shape) {
  const std::span corners = (shape.hull.isEmpty() ? shape.mesh : shape.hull).positions();
  if (corners.empty())
    throw Error({.what = "distance of shapes",
                 .found = fmt::format("a {} without points", toString(shape.type)),
                 .wanted = "its mesh to be loaded"});
  return corners;
}

Vector3d supportOf(std::span<const Eigen::Vector3f> points, const Vector3d& direction) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double along = points[i].cast<double>().dot(direction); along > most) most = along, best = i;
  return points[best].cast<double>();
}

}  // namespace

ConvexCore::ConvexCore(const Shape& shape) {
  const double halfLength = shape.extent.z() / 2;
  switch (shape.type) {
    case ShapeType::kBox:
      half_ = shape.extent / 2;
      return;
    case ShapeType::kRoundedBox:
      radius_ = std::min(shape.radius, shape.extent.minCoeff() / 2);
      half_ = shape.extent / 2 - Vector3d::Constant(radius_);
      return;
    case ShapeType::kSphere:
      radius_ = shape.radius;
      return;
    case ShapeType::kCapsule:
      radius_ = shape.radius;
      half_ = {0, 0, halfLength};
      return;
    case ShapeType::kCylinder:
      kind_ = Kind::kCylinder;
      half_ = {shape.radius, shape.radius, halfLength};
      return;
    case ShapeType::kSphereSweptConvex:
      radius_ = shape.radius;
      [[fallthrough]];
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
      kind_ = Kind::kPoints;
      points_ = cornersOf(shape);
      return;
    case ShapeType::kMarker:
      throw Error({.what = "distance of shapes", .found = "a marker", .wanted = "a solid"});
  }
}

Vector3d ConvexCore::support(const Vector3d& direction) const {
  if (kind_ == Kind::kPoints) return supportOf(points_, direction);
  Vector3d corner = half_;
  if (kind_ == Kind::kCylinder) {
    const double across = std::hypot(direction.x(), direction.y());
    // Straight along the axis the whole cap lies farthest; its middle is as good as any point of it.
    const double scale = across > 0 ? half_.x() / across : 0;
    corner.head<2>() = scale * direction.head<2>();
  } else {
    corner.x() = std::copysign(half_.x(), direction.x());
    corner.y() = std::copysign(half_.y(), direction.y());
  }
  corner.z() = std::copysign(half_.z(), direction.z());
  return corner;
}

}  // namespace rex::internal
