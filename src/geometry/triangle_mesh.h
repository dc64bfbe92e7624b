#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// A picture to paint surfaces with: rows from bottom to top, a pixel is red, green, blue (sRGB).
struct Texture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb{};  ///< 3 width height
};

/// Where a mesh is painted with what: a point (u, v) of the textures for each vertex, or none of all; u to
/// the right and v up, from 0 to 1 and then again.
struct MeshPaint {
  std::vector<Eigen::Vector2f> points{};
  std::vector<Texture> textures{};
};

/// A surface of triangles, or a cloud of points without any, in its own frame, metres. Never changes, so that
/// copies share their data and cost nothing.
class TriangleMesh {
 public:
  /// Corners a, b, c: indices of vertices, counter-clockwise seen from outside.
  using Triangle = std::array<std::uint32_t, 3>;
  /// Successive triangles of one material.
  struct Part {
    std::optional<Eigen::Vector4f> color{};  ///< red, green, blue, alpha (sRGB); none: that of the shape
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    std::optional<std::uint32_t> texture{};  ///< one of the paint, times `color`; none: bare
  };
  using Paint = MeshPaint;

  TriangleMesh() noexcept;
  ~TriangleMesh();
  TriangleMesh(const TriangleMesh&) noexcept;
  TriangleMesh& operator=(const TriangleMesh&) noexcept;
  TriangleMesh(TriangleMesh&&) noexcept;
  TriangleMesh& operator=(TriangleMesh&&) noexcept;
  /// `normals` (unit vectors, outward) are as many as positions, or none for points. Without `parts` all
  /// triangles are one. Throws Error for a number that is not finite, an index of no vertex or texture, sizes
  /// that differ or parts that do not cover the triangles one after the other.
  TriangleMesh(std::vector<Eigen::Vector3f> positions, std::vector<Eigen::Vector3f> normals,
               std::vector<Triangle> triangles, std::vector<Part> parts = {}, Paint paint = {});

  [[nodiscard]] bool isEmpty() const { return positions().empty(); }
  [[nodiscard]] std::span<const Eigen::Vector3f> positions() const;
  [[nodiscard]] std::span<const Eigen::Vector3f> normals() const;
  [[nodiscard]] std::span<const Triangle> triangles() const;
  [[nodiscard]] std::span<const Part> parts() const;
  [[nodiscard]] const Paint& paint() const;
  /// The largest |x|, |y| and |z| of all positions, metres; zero without any.
  [[nodiscard]] Eigen::Vector3d halfBounds() const;

  /// True for copies of one mesh: they are the same data, not only equal.
  bool operator==(const TriangleMesh& other) const { return data_ == other.data_; }

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// Throws Error for what TriangleMesh refuses of all but normals.
void requireSurface(const std::vector<Eigen::Vector3f>& positions,
                    const std::vector<TriangleMesh::Triangle>& triangles,
                    const std::vector<TriangleMesh::Part>& parts);

}  // namespace rex
