#include <cassert>
#include <cmath>
#include <limits>

#include "collision/convex_core_internal.h"
#include "collision/core_internal.h"

namespace rex::internal {

using Eigen::Vector3d;

namespace {

// A plain scan: to walk from corner to corner would need neighbours, which nobody has prepared.
Vector3d supportOf(std::span<const Eigen::Vector3f> points, const Vector3d& direction) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double along = points[i].cast<double>().dot(direction); along > most) most = along, best = i;
  return points[best].cast<double>();
}

}  // namespace

ConvexCore::ConvexCore(const Shape& shape) {
  if (shape.type == ShapeType::kCylinder) {
    kind_ = Kind::kCylinder;
    half_ = {shape.radius, shape.radius, shape.extent.z() / 2};
  } else if (usesMesh(shape.type)) {
    kind_ = Kind::kPoints;
    // Without a hull all points do as well, only slower.
    points_ = (shape.hull.isEmpty() ? shape.mesh : shape.hull).positions();
    radius_ = shape.type == ShapeType::kSphereSweptConvex ? shape.radius : 0;
    assert(!points_.empty());
  } else {
    const Core core = coreOf(shape);
    half_ = core.half;
    radius_ = core.radius;
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
