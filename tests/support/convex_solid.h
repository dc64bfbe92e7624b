#pragma once

#include <vector>

#include "base/rng.h"
#include "geometry/pose.h"
#include "geometry/shape.h"

namespace rex {

/// A shape in its place as tests describe it: a core swept by a ball of `sweep`. The core is the hull of
/// corners or, if `disc` is positive, a cylinder: discs of that radius around two corners. Of a cone the
/// corners are its tip and the middle of its base, which is the disc. Of an ellipsoid the corner is its
/// centre.
struct ConvexSolid {
  Shape shape{};
  Pose X_W{};
  double sweep = 0, disc = 0;
  std::vector<Eigen::Vector3d> corners_W;
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> planes_W;  ///< n, n.x <= offset; only of meshes

  /// The least n.x of the points x of the core.
  [[nodiscard]] double least(const Eigen::Vector3d& n) const;
  /// How far a point sticks out of the core, measured along its axes or from its faces; <= 0 inside.
  [[nodiscard]] double outside(const Eigen::Vector3d& p_W) const;
};

[[nodiscard]] ConvexSolid convexSolid(const Shape& shape, const Pose& X_W);

/// A shape of that type some decimetres large; meshes have `corners` points on an ellipsoid, and their hull.
[[nodiscard]] Shape randomConvexShape(Rng& rng, ShapeType type, int corners = 12);

/// A mesh of these points, whose hull is left to be found.
[[nodiscard]] Shape pointsShape(const std::vector<Eigen::Vector3f>& points);

}  // namespace rex
