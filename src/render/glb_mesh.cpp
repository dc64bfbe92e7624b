#include <cmath>
#include <numbers>

#include "render/draw_list_internal.h"
#include "render/glb_mesh_internal.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

constexpr int kSegments = 28;  // around; a replay is looked at closely, and loaded over a network

GlbSurface surfaceOf(const SolidMesh& mesh, const Vector3d& halfSize, double stretch, double lift = 0) {
  GlbSurface surface;
  for (const MeshVertex& vertex : mesh.vertices) {
    const Vector3d unit = Eigen::Map<const Eigen::Vector3f>(vertex.position).cast<double>();
    const Vector3d normal = Eigen::Map<const Eigen::Vector3f>(vertex.normal).cast<double>();
    const Vector3d along = Vector3d::UnitZ() * (stretch * vertex.end + lift);
    surface.positions.push_back((halfSize.cwiseProduct(unit) + along).cast<float>());
    surface.normals.push_back(normal.cwiseQuotient(halfSize).normalized().cast<float>());
  }
  surface.indices.assign(mesh.indices.begin(), mesh.indices.end());
  return surface;
}

// Rings from pole to pole in which every quarter of a sphere is moved to its corner of the box; the faces
// lie between the quarters, those above and below between the corners of the first and the last ring.
GlbSurface roundedBox(const Vector3d& half, double radius) {
  constexpr int kSteps = 4;  // in a quarter
  constexpr int kAround = 4 * (kSteps + 1);
  const double r = std::min(radius, half.minCoeff());
  const Vector3d core = half.array() - r;
  GlbSurface surface;
  for (int ring = 0; ring < 2 * (kSteps + 1); ++ring) {
    const bool upper = ring <= kSteps;
    const double latitude = std::numbers::pi / 2 * (upper ? kSteps - ring : kSteps + 1 - ring) / kSteps;
    for (int k = 0; k < kAround; ++k) {
      const int quarter = k / (kSteps + 1);
      const double angle = std::numbers::pi / 2 * (k - quarter) / kSteps;
      const Vector3d normal(std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle),
                            std::sin(latitude));
      const Vector3d corner(quarter == 0 || quarter == 3 ? 1 : -1, quarter < 2 ? 1 : -1, upper ? 1 : -1);
      surface.positions.push_back((core.cwiseProduct(corner) + r * normal).cast<float>());
      surface.normals.push_back(normal.cast<float>());
    }
  }
  const auto triangle = [&](int a, int b, int c) {
    for (const int corner : {a, b, c}) surface.indices.push_back(static_cast<std::uint32_t>(corner));
  };
  for (int ring = 0; ring < 2 * kSteps + 1; ++ring)
    for (int k = 0; k < kAround; ++k) {
      const int next = (k + 1) % kAround, upper = ring * kAround, lower = upper + kAround;
      triangle(upper + k, lower + k, lower + next);
      triangle(upper + k, lower + next, upper + next);
    }
  const int side = kSteps + 1, last = (2 * kSteps + 1) * kAround;
  triangle(0, side, 2 * side), triangle(0, 2 * side, 3 * side);
  triangle(last, last + 2 * side, last + side), triangle(last, last + 3 * side, last + 2 * side);
  return surface;
}

GlbSurface cone() {
  GlbSurface surface;
  const auto vertex = [&](const Vector3d& position, const Vector3d& normal) {
    surface.positions.push_back(position.cast<float>());
    surface.normals.push_back(normal.normalized().cast<float>());
  };
  for (int k = 0; k < kSegments; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSegments, half = std::numbers::pi / kSegments;
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    vertex(out, out + Vector3d::UnitZ());
    vertex(Vector3d::UnitZ(), {std::cos(angle + half), std::sin(angle + half), 1});
    vertex(out, -Vector3d::UnitZ());
  }
  for (std::uint32_t k = 0; k < kSegments; ++k) {
    const std::uint32_t next = (k + 1) % kSegments;
    surface.indices.insert(surface.indices.end(), {3 * k, 3 * next, 3 * k + 1});
    if (k > 0 && next > 0) surface.indices.insert(surface.indices.end(), {2, 3 * next + 2, 3 * k + 2});
  }
  return surface;
}

}  // namespace

int GlbMeshes::ofShape(const Shape& shape, const Color& color) {
  const double r = shape.radius;
  const bool hasBox = shape.extent.minCoeff() > 0;
  switch (shape.type) {
    case ShapeType::kBox:
      return hasBox ? add(surfaceOf(makeBoxMesh(), shape.extent / 2, 0), color) : -1;
    case ShapeType::kRoundedBox:
      return hasBox ? add(roundedBox(shape.extent / 2, r), color) : -1;
    case ShapeType::kSphere:
    case ShapeType::kCapsule: {
      const double stretch = shape.type == ShapeType::kCapsule ? shape.extent.z() / 2 : 0;
      const SolidMesh mesh = makeCapsuleMesh(kSegments);
      return r > 0 ? add(surfaceOf(mesh, Vector3d::Constant(r), stretch), color) : -1;
    }
    case ShapeType::kCylinder: {
      const Vector3d halfSize(r, r, shape.extent.z() / 2);
      return halfSize.minCoeff() > 0 ? add(surfaceOf(makeCylinderMesh(kSegments), halfSize, 0), color) : -1;
    }
    case ShapeType::kMarker:
      return ofLines({.solids = {{.shape = shape}}});
    default:
      return ofTriangles(shape.mesh, color);
  }
}

int GlbMeshes::shaft(const Color& color) {
  return add(surfaceOf(makeCylinderMesh(kSegments), {1, 1, 0.5}, 0, 0.5), color);
}

int GlbMeshes::head(const Color& color) { return add(cone(), color); }

int GlbMeshes::ball(const Color& color) {
  return add(surfaceOf(makeCapsuleMesh(kSegments), Vector3d::Ones(), 0), color);
}

int GlbMeshes::plane(double half, const Color& color) {
  const auto h = static_cast<float>(half);
  const std::vector<Eigen::Vector3f> up(4, Eigen::Vector3f::UnitZ());
  return add({{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}}, up, {0, 1, 2, 0, 2, 3}}, color);
}

int GlbMeshes::axes(double size) { return ofLines({.axes = {{.size = size}}}); }

int GlbMeshes::add(const GlbSurface& surface, const Color& color) {
  return intern({{.positions = writer_->addVertices(surface.positions, surface.positions.size()),
                  .normals = writer_->addVertices(surface.normals, surface.normals.size()),
                  .indices = writer_->addIndices(surface.indices),
                  .color = color}});
}

int GlbMeshes::ofTriangles(const TriangleMesh& mesh, const Color& color) {
  if (mesh.triangles().empty()) return -1;
  const int positions = writer_->addVertices(mesh.positions(), mesh.positions().size());
  const int normals = writer_->addVertices(mesh.normals(), mesh.normals().size());
  std::vector<GlbPrimitive> primitives;
  for (const TriangleMesh::Part& part : mesh.parts()) {
    if (part.triangleCount == 0) continue;
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : mesh.triangles().subspan(part.firstTriangle, part.triangleCount))
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    const Eigen::Vector4f own = part.color.value_or(Eigen::Vector4f(color.r, color.g, color.b, color.a));
    primitives.push_back({.positions = positions,
                          .normals = normals,
                          .indices = writer_->addIndices(indices),
                          .color = {own[0], own[1], own[2], own[3]}});
  }
  return intern(primitives);
}

int GlbMeshes::ofLines(const Picture& picture) {
  std::vector<GlbPrimitive> primitives;
  double width = 0;
  for (const Polyline& line : overlayLines(picture)) {
    const std::vector<Eigen::Vector3f> points = {line.points[0].cast<float>(), line.points[1].cast<float>()};
    if (points[0] == points[1]) return -1;
    primitives.push_back({.topology = GlbTopology::kLines,
                          .positions = writer_->addVertices(points, points.size()),
                          .color = line.color});
    width = line.width;
  }
  return intern(primitives, {.numbers = {{"width", {width}}}});
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
  std::vector<float> parts;
  for (const GlbPrimitive& p : primitives) {
    for (const int accessor : {p.positions, p.normals, p.indices})
      parts.push_back(static_cast<float>(accessor));
    parts.insert(parts.end(), {p.color.r, p.color.g, p.color.b, p.color.a});
  }
  const auto known = known_.find({parts, extras});
  if (known != known_.end()) return known->second;
  return known_[{parts, extras}] = writer_->addMesh(primitives, extras);
}

}  // namespace rex::internal
