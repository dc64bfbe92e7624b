#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// An image for surfaces: rows from bottom to top, each pixel red, green, blue (sRGB).
struct Texture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb{};  ///< 3 width height
};

/// The textures of a mesh, and a point (u, v) in them for each vertex, or no points at all. u points to the
/// right and v up; they range from 0 to 1 and then repeat.
struct MeshPaint {
  std::vector<Eigen::Vector2f> points{};
  std::vector<Texture> textures{};
};

/// A surface of triangles, or a cloud of points without triangles, in its own frame, metres. Immutable, so
/// copies share their data and cost nothing.
class TriangleMesh {
 public:
  /// Corners a, b, c: indices of vertices, counter-clockwise seen from outside.
  using Triangle = std::array<std::uint32_t, 3>;
  /// Successive triangles of one material.
  struct Part {
    std::optional<Eigen::Vector4f> color{};  ///< red, green, blue, alpha (sRGB); none: the shape's colour
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    std::optional<std::uint32_t> texture{};  ///< index in the paint, times `color`; none: untextured
  };
  using Paint = MeshPaint;

  TriangleMesh() noexcept;
  ~TriangleMesh();
  TriangleMesh(const TriangleMesh&) noexcept;
  TriangleMesh& operator=(const TriangleMesh&) noexcept;
  TriangleMesh(TriangleMesh&&) noexcept;
  TriangleMesh& operator=(TriangleMesh&&) noexcept;
  /// There is one of `normals` (unit vectors, outward) for each position, or none for a point cloud.
  /// Without `parts`, all triangles form one part. Throws Error for numbers that are not finite, an index
  /// without a vertex or texture, sizes that differ, or parts that do not cover the triangles in order.
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

  /// True for copies of one mesh: they share the same data, which is more than being equal.
  bool operator==(const TriangleMesh& other) const { return data_ == other.data_; }

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// Throws Error for everything that TriangleMesh refuses, except normals.
void requireSurface(const std::vector<Eigen::Vector3f>& positions,
                    const std::vector<TriangleMesh::Triangle>& triangles,
                    const std::vector<TriangleMesh::Part>& parts);

}  // namespace rex
