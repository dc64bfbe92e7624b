#pragma once

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "support/mesh_samples.h"

namespace rex {

/// A face: its centre, and half edges u and v whose cross product points outward.
struct BlockFace {
  Eigen::Vector3d center, u, v;
  Eigen::Vector3d normal() const { return u.cross(v).normalized(); }
  double area() const { return 4 * u.cross(v).norm(); }
};

/// The faces between blocks of a grid and what is outside; `lines` are the planes along each axis.
inline std::vector<BlockFace> facesOf(const std::vector<std::array<int, 3>>& blocks,
                                      const std::array<std::vector<double>, 3>& lines) {
  std::vector<BlockFace> faces;
  for (const std::array<int, 3>& block : blocks) {
    Eigen::Vector3d center, half;
    for (int i = 0; i < 3; ++i) {
      const double low = lines[i][block[i]], high = lines[i][block[i] + 1];
      center[i] = (low + high) / 2;
      half[i] = (high - low) / 2;
    }
    for (int i = 0; i < 3; ++i) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> neighbour = block;
        neighbour[i] += side;
        if (std::find(blocks.begin(), blocks.end(), neighbour) != blocks.end()) continue;
        const int a = (i + (side > 0 ? 1 : 2)) % 3, b = 3 - i - a;
        faces.push_back({center + side * half[i] * Eigen::Vector3d::Unit(i),
                         half[a] * Eigen::Vector3d::Unit(a), half[b] * Eigen::Vector3d::Unit(b)});
      }
    }
  }
  return faces;
}

/// An L of three blocks, 4 m^3, the sample whose masses MuJoCo 3.3.8 was asked for; open: without its top.
inline std::vector<BlockFace> profileSample(bool open) {
  std::vector<BlockFace> faces = facesOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, {0, 1, 3}, {0, 1}}});
  if (open) std::erase_if(faces, [](const BlockFace& face) { return face.normal().z() > .5; });
  return faces;
}

/// Two triangles for each face, which share no vertices.
inline BareMesh trianglesOf(const std::vector<BlockFace>& faces) {
  BareMesh mesh;
  for (const BlockFace& face : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      mesh.positions.push_back((face.center + s * face.u + t * face.v).cast<float>());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

/// The text of an OBJ file.
inline std::string objText(const BareMesh& mesh) {
  std::ostringstream text;
  for (const Eigen::Vector3f& p : mesh.positions) text << "v " << p.transpose() << '\n';
  for (const auto& [a, b, c] : mesh.triangles) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return text.str();
}

}  // namespace rex
