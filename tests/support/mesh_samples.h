#pragma once

#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/triangle_mesh.h"

namespace rex {

/// Bare triangles for weldedMesh() and for files.
struct BareMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<TriangleMesh::Triangle> triangles;
};

/// The cube [-half, half]^3 of eight corners and twelve triangles.
inline BareMesh cubeSample(float half) {
  BareMesh cube;
  for (int i = 0; i < 8; ++i)
    cube.positions.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return cube;
}

/// A sphere about the origin: an octahedron whose triangles are cut into four `depth` times.
inline BareMesh sphereSample(float radius, int depth) {
  BareMesh sphere;
  for (const float sign : {1.f, -1.f})
    for (int axis = 0; axis < 3; ++axis) sphere.positions.push_back(sign * Eigen::Vector3f::Unit(axis));
  sphere.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (int i = 0; i < depth; ++i) {
    std::vector<TriangleMesh::Triangle> finer;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(sphere.positions.size()));
      if (isNew) sphere.positions.push_back((sphere.positions[a] + sphere.positions[b]).normalized());
      return found->second;
    };
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = finer;
  }
  for (Eigen::Vector3f& position : sphere.positions) position *= radius;
  return sphere;
}

/// The volume that a closed mesh encloses, m^3; negative if it is inside out.
inline double volumeOf(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const auto at = [&](std::uint32_t i) -> Eigen::Vector3d { return mesh.positions()[i].cast<double>(); };
    six += at(a).dot(at(b).cross(at(c)));
  }
  return six / 6;
}

/// The area of all triangles, m^2.
inline double areaOf(const TriangleMesh& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const auto at = [&](std::uint32_t i) -> Eigen::Vector3d { return mesh.positions()[i].cast<double>(); };
    twice += (at(b) - at(a)).cross(at(c) - at(a)).norm();
  }
  return twice / 2;
}

}  // namespace rex
