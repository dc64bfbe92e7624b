#include <algorithm>

#include "render/glb_mesh_internal.h"
#include "render/mark_style_internal.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 28;  // around it; a replay is looked at closely, and loaded over a network

GlbSurface surfaceOf(const SolidMesh& mesh, const Vector3d& halfSize,
                     const Vector3d& stretch = Vector3d::Zero(), double lift = 0) {
  GlbSurface surface;
  for (const MeshVertex& vertex : mesh.vertices) {
    const Vector3d unit = Eigen::Map<const Eigen::Vector3f>(vertex.position).cast<double>();
    const Vector3d normal = Eigen::Map<const Eigen::Vector3f>(vertex.normal).cast<double>();
    const Vector3d end = Eigen::Map<const Eigen::Vector3f>(vertex.end).cast<double>();
    const Vector3d at = halfSize.cwiseProduct(unit) + stretch.cwiseProduct(end) + Vector3d(0, 0, lift);
    surface.positions.push_back(at.cast<float>());
    surface.normals.push_back(normal.cwiseQuotient(halfSize).normalized().cast<float>());
  }
  surface.indices.assign(mesh.indices.begin(), mesh.indices.end());
  return surface;
}

}  // namespace

int GlbMeshes::ofShape(const Shape& shape, const Color& color) {
  const double r = shape.radius;
  const bool hasBox = shape.extent.minCoeff() > 0;
  switch (shape.type) {
    case ShapeType::kBox:
      return hasBox ? add(surfaceOf(makeBoxMesh(), shape.extent / 2), color) : -1;
    case ShapeType::kRoundedBox:
      return hasBox ? ofRoundedBox(shape, color) : -1;
    case ShapeType::kSphere:
    case ShapeType::kCapsule: {
      const double stretch = shape.type == ShapeType::kCapsule ? shape.extent.z() / 2 : 0;
      const SolidMesh mesh = makeCapsuleMesh(kSides);
      return r > 0 ? add(surfaceOf(mesh, Vector3d::Constant(r), {0, 0, stretch}), color) : -1;
    }
    case ShapeType::kEllipsoid:
      return hasBox ? add(surfaceOf(makeCapsuleMesh(kSides), shape.extent / 2), color) : -1;
    case ShapeType::kCylinder:
    case ShapeType::kCone: {
      const Vector3d halfSize(r, r, shape.extent.z() / 2);
      const auto make = shape.type == ShapeType::kCone ? makeConeMesh : makeCylinderMesh;
      return halfSize.minCoeff() > 0 ? add(surfaceOf(make(kSides), halfSize), color) : -1;
    }
    case ShapeType::kMarker:
      return ofAxes(-shape.extent.x() / 2, shape.extent.x() / 2);
    case ShapeType::kMesh:
    case ShapeType::kPointCloud:
    case ShapeType::kSphereSweptConvex:
      return ofMesh(shape, color);
  }
  return -1;
}

int GlbMeshes::shaft(const Color& color) {
  return add(surfaceOf(makeCylinderMesh(kSides), {1, 1, 0.5}, Vector3d::Zero(), 0.5), color);
}

int GlbMeshes::head(const Color& color) {
  return add(surfaceOf(makeConeMesh(kSides), {1, 1, 0.5}, Vector3d::Zero(), 0.5), color);
}

int GlbMeshes::ball(const Color& color) {
  return add(surfaceOf(makeCapsuleMesh(kSides), Vector3d::Ones()), color);
}

int GlbMeshes::plane(double half, const Color& color) {
  const auto h = static_cast<float>(half);
  const std::vector<Eigen::Vector3f> up(4, Eigen::Vector3f::UnitZ());
  return add({{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}}, up, {0, 1, 2, 0, 2, 3}}, color);
}

int GlbMeshes::axes(double size) { return ofAxes(0, size); }

int GlbMeshes::add(const GlbSurface& surface, const Color& color) {
  return intern({{.positions = writer_->addVertices(surface.positions, surface.positions.size()),
                  .normals = writer_->addVertices(surface.normals, surface.normals.size()),
                  .indices = writer_->addIndices(surface.indices),
                  .color = color}});
}

int GlbMeshes::ofMesh(const Shape& shape, const Color& color) {
  const TriangleMesh& mesh = shape.mesh;
  if (mesh.isEmpty()) return -1;
  const int positions = writer_->addVertices(mesh.positions(), mesh.positions().size());
  if (mesh.triangles().empty() || shape.type == ShapeType::kPointCloud)
    return points(positions, color, 2 * kCloudPointRadius);
  const int normals = writer_->addVertices(mesh.normals(), mesh.normals().size());
  std::vector<GlbPrimitive> primitives;
  for (const TriangleMesh::Part& part : mesh.parts()) {
    if (part.triangleCount == 0) continue;
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : mesh.triangles().subspan(part.firstTriangle, part.triangleCount))
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    Eigen::Vector4f own = part.color.value_or(Eigen::Vector4f(color.r, color.g, color.b, 1));
    own[3] *= color.a;
    primitives.push_back({.positions = positions,
                          .normals = normals,
                          .indices = writer_->addIndices(indices),
                          .color = {own[0], own[1], own[2], own[3]},
                          .doubleSided = true});  // it may be open
  }
  return intern(primitives);
}

int GlbMeshes::ofRoundedBox(const Shape& shape, const Color& color) {
  const Vector3d half = shape.extent / 2;
  const double r = std::min(shape.radius, half.minCoeff());
  if (!(r > 0)) return add(surfaceOf(makeBoxMesh(), half), color);
  return add(surfaceOf(makeRoundedBoxMesh(kSides), Vector3d::Constant(r), half.array() - r), color);
}

int GlbMeshes::ofAxes(double from, double to) {
  if (from == to) return -1;
  std::vector<GlbPrimitive> primitives;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f axis = Eigen::Vector3f::Unit(i);
    const std::vector<Eigen::Vector3f> ends = {static_cast<float>(from) * axis,
                                               static_cast<float>(to) * axis};
    primitives.push_back({.topology = GlbTopology::kLines,
                          .positions = writer_->addVertices(ends, ends.size()),
                          .color = kAxisColors[static_cast<std::size_t>(i)]});
  }
  return intern(primitives, {.numbers = {{"width", {kAxisWidth}}}});
}

int GlbMeshes::lines(int positions, const Color& color, double width) {
  return intern({{.topology = GlbTopology::kLines, .positions = positions, .color = color}},
                {.numbers = {{"width", {width}}}});
}

int GlbMeshes::line(int positions, const Color& color, double width) {
  return intern({{.topology = GlbTopology::kLineStrip, .positions = positions, .color = color}},
                {.numbers = {{"width", {width}}}});
}

int GlbMeshes::points(int positions, const Color& color, double size) {
  return intern({{.topology = GlbTopology::kPoints, .positions = positions, .color = color}},
                {.numbers = {{"size", {size}}}});
}

int GlbMeshes::intern(const std::vector<GlbPrimitive>& primitives, const GlbExtras& extras) {
  std::vector<Part> parts;
  for (const auto& [topology, positions, normals, indices, color, doubleSided] : primitives)
    parts.push_back(
        {topology, positions, normals, indices, doubleSided, {color.r, color.g, color.b, color.a}});
  const auto known = known_.find({parts, extras});
  if (known != known_.end()) return known->second;
  return known_[{parts, extras}] = writer_->addMesh(primitives, extras);
}

}  // namespace rex::internal
