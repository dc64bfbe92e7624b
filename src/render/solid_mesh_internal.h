#pragma once

#include <cstdint>
#include <vector>

namespace rex::internal {

/// A corner of a unit mesh. A solid of half size s and stretch h (both per axis) puts it at
/// s * position + h * end; its normal is then along normal / s. So one mesh serves capsules of every length,
/// with round caps, and one the boxes with rounded edges.
struct MeshVertex {
  float position[3];
  float normal[3];
  float end[3];  ///< each -1, 0 or 1
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
/// The unit sphere cut into its octants, each with its signs as `end`: stretched, a box with rounded edges.
/// `segments` (a multiple of 4) around.
[[nodiscard]] SolidMesh makeRoundedBoxMesh(int segments);
/// The cone with a disc of radius 1 at z = -1 and its tip at z = 1.
[[nodiscard]] SolidMesh makeConeMesh(int segments);

}  // namespace rex::internal
