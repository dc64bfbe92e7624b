#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace rex {

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
  };

  TriangleMesh() noexcept;
  ~TriangleMesh();
  TriangleMesh(const TriangleMesh&) noexcept;
  TriangleMesh& operator=(const TriangleMesh&) noexcept;
  TriangleMesh(TriangleMesh&&) noexcept;
  TriangleMesh& operator=(TriangleMesh&&) noexcept;
  /// `normals` (unit vectors, outward) are as many as positions, or none for points. Without `parts` all
  /// triangles are one. Throws Error for a number that is not finite, an index of no vertex, sizes that
  /// differ or parts that do not cover the triangles one after the other.
  TriangleMesh(std::vector<Eigen::Vector3f> positions, std::vector<Eigen::Vector3f> normals,
               std::vector<Triangle> triangles, std::vector<Part> parts = {});

  [[nodiscard]] bool isEmpty() const { return positions().empty(); }
  [[nodiscard]] std::span<const Eigen::Vector3f> positions() const;
  [[nodiscard]] std::span<const Eigen::Vector3f> normals() const;
  [[nodiscard]] std::span<const Triangle> triangles() const;
  [[nodiscard]] std::span<const Part> parts() const;
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
