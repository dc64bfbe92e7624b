#include <cassert>
#include <cmath>
#include <numbers>

#include "render/solid_mesh_internal.h"

namespace rex::internal {
namespace {

std::uint16_t index(int i) { return static_cast<std::uint16_t>(i); }

void addTriangle(SolidMesh& mesh, int a, int b, int c) {
  mesh.indices.insert(mesh.indices.end(), {index(a), index(b), index(c)});
}

// The radius of the corners of a polygon whose edges touch the unit circle. The faces of a sphere made of
// such polygons lie as far inside as its corners outside.
double cornerRadius(int segments) { return 1 / std::cos(std::numbers::pi / segments); }

// A ring of vertices with radius r at height z; the normal leans by (radial, along).
void addRing(SolidMesh& mesh, int segments, double r, double z, double radial, double along, int end) {
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * std::numbers::pi * k / segments;
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const auto rf = static_cast<float>(r), radialF = static_cast<float>(radial);
    mesh.vertices.push_back({{rf * c, rf * s, static_cast<float>(z)},
                             {radialF * c, radialF * s, static_cast<float>(along)},
                             {0, 0, static_cast<float>(end)}});
  }
}

// Joins the ring starting at vertex `upper` with the one below it.
void addBand(SolidMesh& mesh, int segments, int upper, int lower) {
  for (int k = 0; k < segments; ++k) {
    const int next = (k + 1) % segments;
    addTriangle(mesh, upper + k, lower + k, lower + next);
    addTriangle(mesh, upper + k, lower + next, upper + next);
  }
}

}  // namespace

std::size_t detailFor(double radiusInPixels) {
  constexpr double kTolerance = 0.5;  // pixels
  std::size_t detail = 0;
  while (detail + 1 < kSegments.size() && radiusInPixels * (cornerRadius(kSegments[detail]) - 1) > kTolerance)
    ++detail;
  return detail;
}

SolidMesh makeBoxMesh() {
  SolidMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.f, 1.f}) {
      const int first = static_cast<int>(mesh.vertices.size());
      for (const auto& [u, v] : {std::pair{-1.f, -1.f}, {1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}}) {
        MeshVertex vertex{};
        vertex.position[axis] = vertex.normal[axis] = side;
        vertex.position[(axis + 1) % 3] = side * u;
        vertex.position[(axis + 2) % 3] = v;
        mesh.vertices.push_back(vertex);
      }
      addTriangle(mesh, first, first + 1, first + 2);
      addTriangle(mesh, first, first + 2, first + 3);
    }
  }
  return mesh;
}

SolidMesh makeCapsuleMesh(int segments) {
  assert(segments % 4 == 0);
  const int rings = segments / 4;  // from a pole to the equator, which both halves have
  SolidMesh mesh;
  for (const int end : {1, -1}) {
    for (int k = 0; k <= rings; ++k) {
      const double latitude = std::numbers::pi / 2 * (end > 0 ? rings - k : -k) / rings;
      const double r = std::cos(latitude), z = std::sin(latitude), size = cornerRadius(segments);
      addRing(mesh, segments, size * r, size * z, r, z, end);
    }
  }
  for (int ring = 0; ring < 2 * rings + 1; ++ring)
    addBand(mesh, segments, ring * segments, (ring + 1) * segments);
  return mesh;
}

SolidMesh makeCylinderMesh(int segments) {
  const double size = cornerRadius(segments);
  SolidMesh mesh;
  addRing(mesh, segments, size, 1, 0, 1, 0);
  addRing(mesh, segments, size, 1, 1, 0, 0);
  addRing(mesh, segments, size, -1, 1, 0, 0);
  addRing(mesh, segments, size, -1, 0, -1, 0);
  addBand(mesh, segments, segments, 2 * segments);
  const int bottom = 3 * segments;
  for (int k = 1; k + 1 < segments; ++k) {
    addTriangle(mesh, 0, k, k + 1);
    addTriangle(mesh, bottom, bottom + k + 1, bottom + k);
  }
  return mesh;
}

SolidMesh makeRoundedBoxMesh(int segments) {
  assert(segments % 4 == 0);
  const int rings = segments / 4, corners = rings + 1;  // from one flat side to the next
  SolidMesh mesh;
  for (const float up : {1.f, -1.f}) {
    for (int ring = 0; ring <= rings; ++ring) {
      const double latitude = std::numbers::pi / 2 * (up > 0 ? rings - ring : -ring) / rings;
      for (int k = 0; k < 4 * corners; ++k) {
        const int quarter = k / corners;
        const double angle = std::numbers::pi / 2 * (quarter + static_cast<double>(k % corners) / rings);
        const auto x = static_cast<float>(std::cos(latitude) * std::cos(angle)),
                   y = static_cast<float>(std::cos(latitude) * std::sin(angle)),
                   z = static_cast<float>(std::sin(latitude));
        const float right = quarter == 0 || quarter == 3 ? 1 : -1, back = quarter < 2 ? 1 : -1;
        mesh.vertices.push_back({{x, y, z}, {x, y, z}, {right, back, up}});
      }
    }
  }
  const int around = 4 * corners, bottom = (2 * rings + 1) * around;
  for (int ring = 0; ring < 2 * rings + 1; ++ring) addBand(mesh, around, ring * around, (ring + 1) * around);
  for (int quarter = 1; quarter < 3; ++quarter) {
    addTriangle(mesh, 0, quarter * corners, (quarter + 1) * corners);
    addTriangle(mesh, bottom, bottom + (quarter + 1) * corners, bottom + quarter * corners);
  }
  return mesh;
}

SolidMesh makeConeMesh(int segments) {
  const double radial = 2 / std::sqrt(5), along = 1 / std::sqrt(5);  // across the line from (1, -1) to (0, 1)
  SolidMesh mesh;
  addRing(mesh, segments, 0, 1, radial, along, 0);
  addRing(mesh, segments, cornerRadius(segments), -1, radial, along, 0);
  addRing(mesh, segments, cornerRadius(segments), -1, 0, -1, 0);
  addBand(mesh, segments, 0, segments);
  const int bottom = 2 * segments;
  for (int k = 1; k + 1 < segments; ++k) addTriangle(mesh, bottom, bottom + k + 1, bottom + k);
  return mesh;
}

}  // namespace rex::internal
