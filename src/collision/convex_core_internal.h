#pragma once

#include <span>

#include "geometry/shape.h"

namespace rex::internal {

/// A solid as all points within `radius` metres of a convex core, as Core has it, but also of cylinders,
/// cones, ellipsoids, and of meshes and clouds, whose points are the corners. It refers to the points of the
/// shape, which must outlive it.
class ConvexCore {
 public:
  /// Of shapes that pass requireSolid().
  explicit ConvexCore(const Shape& shape);

  double radius() const { return radius_; }
  /// Whether the core has curved sides, which no finite number of points describes.
  bool isCurved() const { return kind_ != Kind::kBox && kind_ != Kind::kPoints; }
  /// A point of the core that lies farthest along `direction`, in the frame of the shape.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

 private:
  enum class Kind { kBox, kCylinder, kCone, kEllipsoid, kPoints };
  Kind kind_ = Kind::kBox;
  double radius_ = 0;
  Eigen::Vector3d half_{0, 0, 0};  // of the box around it, but for points
  std::span<const Eigen::Vector3f> points_{};
};

}  // namespace rex::internal
