#pragma once

#include <vector>

#include <Eigen/Core>

namespace rex {

/// How deep the origin lies below the surface of the convex hull of the points, by qhull; negative outside,
/// where it is the distance from the plane of a face.
[[nodiscard]] double hullDepth(const std::vector<Eigen::Vector3d>& points);

}  // namespace rex
