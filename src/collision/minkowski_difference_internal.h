#pragma once

#include <array>

#include <Eigen/Geometry>

#include "collision/convex_core_internal.h"
#include "geometry/pose.h"

namespace rex::internal {

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
