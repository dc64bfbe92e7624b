#pragma once

#include <span>

#include "geometry/shape.h"

namespace rex::internal {

/// A convex solid as all points within `radius` metres of a core: of a sphere the core is a point, of a
/// capsule a segment, of a rounded box a box; meshes and clouds have their points as corners. It refers to
/// the points of the shape, which must outlive it. Throws Error for a marker, and for a missing mesh.
class ConvexCore {
 public:
  explicit ConvexCore(const Shape& shape);

  double radius() const { return radius_; }
  /// Whether the core has curved sides, which no finite number of support points describes.
  bool isCurved() const { return kind_ == Kind::kCylinder; }
  /// A point of the core that lies farthest along `direction`, in the frame of the shape.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

 private:
  enum class Kind { kBox, kCylinder, kPoints };
  Kind kind_ = Kind::kBox;
  double radius_ = 0;
  Eigen::Vector3d half_ = Eigen::Vector3d::Zero();  // of the box around it, but for points
  std::span<const Eigen::Vector3f> points_{};
};

}  // namespace rex::internal
