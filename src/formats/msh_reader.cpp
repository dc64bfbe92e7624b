#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "formats/mesh_limits_internal.h"
#include "formats/mesh_reader_internal.h"
#include "geometry/convex_hull.h"
#include "geometry/welded_mesh.h"

namespace rex::mesh {
namespace {

using Eigen::Vector3f;

// As many elements as there are counted, which are known to be there.
template <class T>
std::vector<T> takeMany(std::string_view& bytes, std::size_t count) {
  std::vector<T> many(count);
  if (count > 0) std::memcpy(static_cast<void*>(many.data()), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return many;
}

}  // namespace

TriangleMesh readMsh(std::string_view bytes, const std::string& name) {
  constexpr const char* kThing = "MSH file";
  std::int32_t counts[4] = {};  // vertices, normals, points in textures, faces
  if (bytes.size() < sizeof counts)
    fail(name, kThing, fmt::format("{} bytes", bytes.size()), "MuJoCo's format");
  std::memcpy(counts, bytes.data(), sizeof counts);
  bytes.remove_prefix(sizeof counts);
  const auto most = static_cast<std::int32_t>(kMostVertices);
  if (*std::ranges::min_element(counts) < 0 || *std::ranges::max_element(counts) > most || counts[0] == 0)
    fail(name, kThing, fmt::format("{} vertices and {} faces", counts[0], counts[3]),
         "MuJoCo's format, with 1 to 2100000 vertices");
  requireTriangles(static_cast<std::size_t>(counts[3]), name);
  const auto vertices = static_cast<std::size_t>(counts[0]), normals = static_cast<std::size_t>(counts[1]),
             points = static_cast<std::size_t>(counts[2]), faces = static_cast<std::size_t>(counts[3]);
  const std::size_t wanted = 4 * (3 * vertices + 3 * normals + 2 * points + 3 * faces);
  if (bytes.size() != wanted)
    fail(name, kThing, fmt::format("{} bytes after its counts", bytes.size()), fmt::format("{}", wanted));
  const auto positions = takeMany<Vector3f>(bytes, vertices);
  for (const Vector3f& p : positions)
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargestCoordinate)
      fail(name, kThing, fmt::format("a vertex at ({}, {}, {})", p.x(), p.y(), p.z()),
           "finite numbers up to 1e6");
  bytes.remove_prefix(4 * (3 * normals + 2 * points));
  if (faces == 0) return convexHull(positions);  // as MuJoCo
  const auto triangles = takeMany<TriangleMesh::Triangle>(bytes, faces);
  for (const TriangleMesh::Triangle& triangle : triangles)
    if (const std::uint32_t corner = *std::ranges::max_element(triangle); corner >= vertices)
      fail(name, kThing, fmt::format("a face with corner {}", static_cast<std::int32_t>(corner)),
           fmt::format("indices below {}, the number of vertices", vertices));
  TriangleMesh mesh = weldedMesh(positions, triangles);
  if (mesh.isEmpty())
    fail(name, "mesh", fmt::format("{} triangles, none of which has an area", faces), "a surface");
  return mesh;
}

}  // namespace rex::mesh
