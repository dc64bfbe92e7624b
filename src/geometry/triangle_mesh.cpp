#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

void requireFinite(const std::vector<Eigen::Vector3f>& vectors, const char* kind) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (!vectors[i].allFinite())
      throw Error({.what = "mesh",
                   .found = fmt::format("{} {} = ({}, {}, {})", kind, i, vectors[i].x(), vectors[i].y(),
                                        vectors[i].z()),
                   .wanted = "finite numbers"});
  }
}

void requireTriangles(const std::vector<TriangleMesh::Triangle>& triangles, std::size_t vertexCount) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t corner : triangles[i]) {
      if (corner >= vertexCount)
        throw Error({.what = "mesh",
                     .found = fmt::format("triangle {} with corner {}", i, corner),
                     .wanted = fmt::format("indices below {}, the number of vertices", vertexCount)});
    }
  }
}

void requireParts(const std::vector<TriangleMesh::Part>& parts, std::size_t triangleCount) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].firstTriangle != next)
      throw Error({.what = "mesh",
                   .found = fmt::format("part {} starting at triangle {}", i, parts[i].firstTriangle),
                   .wanted = fmt::format("triangle {}, where the part before ends", next)});
    next += parts[i].triangleCount;
  }
  if (next != triangleCount)
    throw Error({.what = "mesh",
                 .found = fmt::format("parts with {} triangles in total", next),
                 .wanted = fmt::format("all {}", triangleCount)});
}

void requirePaint(const TriangleMesh::Paint& paint, const std::vector<TriangleMesh::Part>& parts,
                  std::size_t vertexCount) {
  const auto fail = [](std::string found, std::string wanted) {
    return Error({.what = "mesh", .found = std::move(found), .wanted = std::move(wanted)});
  };
  if (!paint.points.empty() && paint.points.size() != vertexCount)
    throw fail(fmt::format("{} texture coordinates", paint.points.size()),
               fmt::format("{}, one for each vertex, or none", vertexCount));
  for (const Eigen::Vector2f& point : paint.points)
    if (!point.allFinite()) throw fail("a texture coordinate that is not finite", "finite numbers");
  for (const Texture& texture : paint.textures) {
    const auto width = static_cast<std::size_t>(std::max(texture.width, 0)),
               height = static_cast<std::size_t>(std::max(texture.height, 0));
    if (width * height == 0 || texture.rgb.size() != 3 * width * height)
      throw fail(fmt::format("a texture of {} x {} pixels with {} bytes", texture.width, texture.height,
                             texture.rgb.size()),
                 "three bytes for each pixel, and at least one");
  }
  for (const TriangleMesh::Part& part : parts)
    if (part.texture && (*part.texture >= paint.textures.size() || paint.points.empty()))
      throw fail(fmt::format("a part with texture {}", *part.texture),
                 fmt::format("one below {}, and texture coordinates", paint.textures.size()));
}

template <typename T>
std::span<const T> view(const std::vector<T>& values) {
  return {values.data(), values.size()};
}

}  // namespace

void requireSurface(const std::vector<Eigen::Vector3f>& positions,
                    const std::vector<TriangleMesh::Triangle>& triangles,
                    const std::vector<TriangleMesh::Part>& parts) {
  requireFinite(positions, "vertex");
  requireTriangles(triangles, positions.size());
  if (!parts.empty()) requireParts(parts, triangles.size());
}

struct TriangleMesh::Data {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<Triangle> triangles;
  std::vector<Part> parts;
  Paint paint;
  Eigen::Vector3f halfBounds;
};

TriangleMesh::TriangleMesh() noexcept = default;
TriangleMesh::~TriangleMesh() = default;
TriangleMesh::TriangleMesh(const TriangleMesh&) noexcept = default;
TriangleMesh& TriangleMesh::operator=(const TriangleMesh&) noexcept = default;
TriangleMesh::TriangleMesh(TriangleMesh&&) noexcept = default;
TriangleMesh& TriangleMesh::operator=(TriangleMesh&&) noexcept = default;

TriangleMesh::TriangleMesh(std::vector<Eigen::Vector3f> positions, std::vector<Eigen::Vector3f> normals,
                           std::vector<Triangle> triangles, std::vector<Part> parts, Paint paint) {
  requireFinite(normals, "normal");
  const bool needsNormals = !triangles.empty() || !normals.empty();
  if (needsNormals && normals.size() != positions.size())
    throw Error({.what = "mesh",
                 .found = fmt::format("{} normals", normals.size()),
                 .wanted = fmt::format("{}, one for each vertex", positions.size())});
  requireSurface(positions, triangles, parts);
  requirePaint(paint, parts, positions.size());
  if (parts.empty() && !triangles.empty())
    parts.push_back({.triangleCount = static_cast<std::uint32_t>(triangles.size())});
  Eigen::Vector3f halfBounds = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& position : positions) halfBounds = halfBounds.cwiseMax(position.cwiseAbs());
  data_ = std::make_shared<const Data>(Data{std::move(positions), std::move(normals), std::move(triangles),
                                            std::move(parts), std::move(paint), halfBounds});
}

std::span<const Eigen::Vector3f> TriangleMesh::positions() const {
  return data_ ? view(data_->positions) : std::span<const Eigen::Vector3f>();
}
std::span<const Eigen::Vector3f> TriangleMesh::normals() const {
  return data_ ? view(data_->normals) : std::span<const Eigen::Vector3f>();
}
std::span<const TriangleMesh::Triangle> TriangleMesh::triangles() const {
  return data_ ? view(data_->triangles) : std::span<const Triangle>();
}
std::span<const TriangleMesh::Part> TriangleMesh::parts() const {
  return data_ ? view(data_->parts) : std::span<const Part>();
}
const TriangleMesh::Paint& TriangleMesh::paint() const {
  static const Paint kBare;
  return data_ ? data_->paint : kBare;
}
Eigen::Vector3d TriangleMesh::halfBounds() const {
  if (!data_) return Eigen::Vector3d::Zero();
  return data_->halfBounds.cast<double>();
}

}  // namespace rex
