#include "geometry/shape.h"

namespace rex {

std::string_view toString(ShapeType type) {
  switch (type) {
    case ShapeType::kBox:
      return "box";
    case ShapeType::kSphere:
      return "sphere";
    case ShapeType::kCapsule:
      return "capsule";
    case ShapeType::kMesh:
      return "mesh";
    case ShapeType::kCylinder:
      return "cylinder";
    case ShapeType::kCone:
      return "cone";
    case ShapeType::kMarker:
      return "marker";
    case ShapeType::kPointCloud:
      return "point cloud";
    case ShapeType::kSphereSweptConvex:
      return "sphere-swept convex mesh";
    case ShapeType::kRoundedBox:
      return "rounded box";
    case ShapeType::kEllipsoid:
      return "ellipsoid";
  }
  return "?";
}

bool usesMesh(ShapeType type) {
  return type == ShapeType::kMesh || type == ShapeType::kPointCloud || type == ShapeType::kSphereSweptConvex;
}

Eigen::Vector3d halfBounds(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kBox:
    case ShapeType::kRoundedBox:
    case ShapeType::kEllipsoid:
      return shape.extent / 2;
    case ShapeType::kSphere:
      return Eigen::Vector3d::Constant(shape.radius);
    case ShapeType::kCapsule:
      return {shape.radius, shape.radius, shape.extent.z() / 2 + shape.radius};
    case ShapeType::kCylinder:
    case ShapeType::kCone:
      return {shape.radius, shape.radius, shape.extent.z() / 2};
    case ShapeType::kMarker:
      return Eigen::Vector3d::Constant(shape.extent.x() / 2);
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
      return shape.mesh.halfBounds();
    case ShapeType::kSphereSweptConvex:
      return shape.mesh.halfBounds() + Eigen::Vector3d::Constant(shape.radius);
  }
  return Eigen::Vector3d::Zero();
}

}  // namespace rex
