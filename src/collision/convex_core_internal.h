#pragma once

#include <array>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include "geometry/pose.h"
#include "geometry/shape.h"

namespace rex::internal {

enum class CoreType { kSegment, kBox, kOther };

/// A shape as a core swept by a ball of `radius`: a segment, half.z long to each side along z, or a box.
struct Core {
  CoreType type = CoreType::kOther;
  Eigen::Vector3d half{0, 0, 0};
  double radius = 0;
};

/// kOther: a cylinder, a cone, or a shape described by a mesh.
[[nodiscard]] Core coreOf(const Shape& shape);

/// Throws Error for what cannot collide: a marker, or a shape whose mesh is not loaded. `what` begins the
/// message.
void requireSolid(const std::string& what, const Shape& shape);

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

/// A point of the difference of two cores, with the point of A it stems from; both in the frame of A.
struct DifferencePoint {
  Eigen::Vector3d x;  ///< onA minus a point of B
  Eigen::Vector3d onA;
};

/// The convex set of all differences of a point of core A and one of core B, seen from A. Its signed distance
/// from the origin is that of the cores: the largest gap(n) of all unit vectors n, where gap(n) is the least
/// n.x of all x of the set. So any n gives a lower bound.
class MinkowskiDifference {
 public:
  MinkowskiDifference(const ConvexCore& a, const ConvexCore& b, const Pose& X_AB)
      : a_(a), b_(b), X_AB_(X_AB) {}

  /// A point with the least n.x.
  DifferencePoint lowest(const Eigen::Vector3d& n) const {
    const Eigen::Vector3d onA = a_.support(-n);
    return {onA - X_AB_ * b_.support(X_AB_.R.transpose() * n), onA};
  }
  /// From the middle of B to that of A.
  Eigen::Vector3d centres() const { return -X_AB_.p; }
  bool isCurved() const { return a_.isCurved() || b_.isCurved(); }
  /// Directions near n along which the gap has sharp ridges, since the sides of cylinders are straight.
  std::array<Eigen::Vector3d, 3> ridges(const Eigen::Vector3d& n) const {
    const Eigen::Vector3d axisA{0, 0, 1}, axisB = X_AB_.R.col(2);
    const Eigen::Vector3d both = axisA.cross(axisB);
    return {n - n.dot(axisA) * axisA, n - n.dot(axisB) * axisB,
            n.dot(both) < 0 ? Eigen::Vector3d(-both) : both};
  }

 private:
  const ConvexCore& a_;
  const ConvexCore& b_;
  Pose X_AB_;
};

/// What is known of two cores: their signed distance, which is `distance` within `slack`, metres.
struct CoreProximity {
  double distance = 0, slack = 0;
  Eigen::Vector3d normal;  ///< unit vector from B towards A
  DifferencePoint nearest;
};

}  // namespace rex::internal
