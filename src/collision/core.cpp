#include <fmt/format.h>

#include "base/error.h"
#include "collision/core_internal.h"

namespace rex::internal {

Core coreOf(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kSphere:
      return {CoreType::kSegment, Eigen::Vector3d::Zero(), shape.radius};
    case ShapeType::kCapsule:
      return {CoreType::kSegment, {0, 0, shape.extent.z() / 2}, shape.radius};
    case ShapeType::kBox:
      return {CoreType::kBox, shape.extent / 2, 0};
    case ShapeType::kRoundedBox:
      return {CoreType::kBox, (shape.extent / 2).array() - shape.radius, shape.radius};
    case ShapeType::kCylinder:
    case ShapeType::kCone:
    case ShapeType::kEllipsoid:
    case ShapeType::kMesh:
    case ShapeType::kSphereSweptConvex:
    case ShapeType::kPointCloud:
    case ShapeType::kMarker:
      break;
  }
  return {};
}

void requireSolid(const std::string& what, const Shape& shape) {
  if (shape.type == ShapeType::kMarker)
    throw Error({.what = what, .found = "a marker", .wanted = "a solid that can collide"});
  if (usesMesh(shape.type) && shape.mesh.isEmpty()) {
    throw Error({.what = what,
                 .found = fmt::format("a {} whose mesh is not loaded", toString(shape.type)),
                 .wanted = "a scene read from a file, or loadMeshes()"});
  }
}

}  // namespace rex::internal
