#pragma once

#include <cstdint>
#include <vector>

namespace rex::internal {

/// A corner of a unit mesh. A solid of half size s (per axis) and stretch h puts it at
/// s * position + (0, 0, h * end); its normal is then along normal / s. So one mesh serves capsules of every
/// length, with round caps.
struct MeshVertex {
  float position[3];
  float normal[3];
  float end;  ///< -1, 0 or 1
};

/// Triangles, counter-clockwise seen from outside.
struct SolidMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint16_t> indices;
};

/// The cube [-1, 1]^3.
[[nodiscard]] SolidMesh makeBoxMesh();
/// The unit sphere, cut at the equator: half of it has end = 1, half -1. `segments` (a multiple of 4) around.
[[nodiscard]] SolidMesh makeCapsuleMesh(int segments);
/// The cylinder of radius 1 about z with |z| <= 1.
[[nodiscard]] SolidMesh makeCylinderMesh(int segments);

}  // namespace rex::internal
