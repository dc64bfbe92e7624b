#pragma once

#include "geometry/pose.h"
#include "geometry/shape.h"

namespace rex {

/// The distance of two solids A and B, with their nearest points. Always p_WA - p_WB = distance * normal_W.
struct Proximity {
  double distance = 0;         ///< metres; in overlap, minus the shortest translation that separates them
  Eigen::Vector3d p_WA, p_WB;  ///< nearest points of the surfaces; in overlap, those that would touch last
  Eigen::Vector3d normal_W;    ///< unit vector from B towards A: moving A along it increases the distance
};

/// The proximity of two shapes at the poses X_WA and X_WB. Exact to 1e-12 for boxes, rounded boxes, spheres
/// and capsules; iterative for others, to 1e-9 when apart and 1e-6 in overlap. Meshes and clouds count as
/// their hulls. Throws Error for a marker, and for a shape that needs a mesh and has none.
[[nodiscard]] Proximity proximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

}  // namespace rex
