#pragma once

#include "geometry/pose.h"
#include "geometry/shape.h"

namespace rex {

/// How two solids A and B lie to one another. p_WA - p_WB = distance * normal_W always.
struct Proximity {
  double distance = 0;         ///< metres; in overlap minus the shortest way apart
  Eigen::Vector3d p_WA, p_WB;  ///< nearest points of the surfaces; in overlap those that would touch last
  Eigen::Vector3d normal_W;    ///< unit vector from B towards A: moving A along it enlarges the distance
};

/// The proximity of two shapes in the poses X_WA and X_WB. Exact to 1e-12 for boxes, also rounded, spheres
/// and capsules; the others iterate, to 1e-9 apart and 1e-6 in overlap. Meshes and clouds count as their
/// hulls. Throws Error for a marker, and for a shape that needs a mesh and has none.
[[nodiscard]] Proximity proximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

}  // namespace rex
