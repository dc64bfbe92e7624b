#pragma once

#include <string_view>

#include <Eigen/Core>

#include "geometry/triangle_mesh.h"

namespace rex {

enum class ShapeType {
  kBox,
  kSphere,
  kCapsule,
  kMesh,
  kCylinder,
  kCone,
  kMarker,
  kPointCloud,
  kSphereSweptConvex,
  kRoundedBox,
  kEllipsoid
};

/// "box", "sphere", ...: the name used in messages.
[[nodiscard]] std::string_view toString(ShapeType type);

/// Whether shapes of the type are described by a mesh: mesh, point cloud and sphere-swept convex mesh.
[[nodiscard]] bool usesMesh(ShapeType type);

/// A solid centred in its own frame; lengths in metres. What `extent` and `radius` mean:
/// box, rounded box: full outer edge lengths x, y, z; the rounded box has corners of `radius`.
/// capsule, cylinder: extent.z is the straight length along z, `radius` the radius; a capsule's caps are
/// added to that length. cone: extent.z is its height, `radius` that of its base at z = -extent.z / 2; the
/// tip points up. sphere: `radius`. ellipsoid: full lengths of its axes x, y, z. marker: a drawing aid of
/// size extent.x without volume. The others are described by `mesh`; a sphere-swept convex mesh extends
/// `radius` beyond it.
struct Shape {
  ShapeType type = ShapeType::kBox;
  Eigen::Vector3d extent{1, 1, 1};
  double radius = 0;
  TriangleMesh mesh{};
  TriangleMesh hull{};  ///< convex hull of `mesh`, for shapes in contact; see loadMeshes()
};

/// Half the edge lengths of the smallest box around the shape, centred at its origin, along its axes.
[[nodiscard]] Eigen::Vector3d halfBounds(const Shape& shape);

}  // namespace rex
