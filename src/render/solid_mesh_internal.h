#pragma once

#include <array>
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

/// How finely round meshes are cut: their corners around, from coarse to fine. Triangles are what a picture
/// of many small solids costs.
inline constexpr std::array<int, 6> kSegments = {8, 12, 16, 24, 48, 96};
/// The coarsest detail with which a circle of this radius is off by no more than half a pixel.
[[nodiscard]] std::size_t detailFor(double radiusInPixels);

/// The cube [-1, 1]^3.
[[nodiscard]] SolidMesh makeBoxMesh();
/// The unit sphere, cut at the equator: half of it has end = 1, half -1. `segments` (a multiple of 4) around.
/// The edges of round meshes touch the round surface, their corners lie outside.
[[nodiscard]] SolidMesh makeCapsuleMesh(int segments);
/// The cylinder of radius 1 about z with |z| <= 1.
[[nodiscard]] SolidMesh makeCylinderMesh(int segments);
/// The unit sphere cut into its octants, each with its signs as `end`: stretched, a box with rounded edges.
/// `segments` (a multiple of 4) around.
[[nodiscard]] SolidMesh makeRoundedBoxMesh(int segments);
/// The cone with a disc of radius 1 at z = -1 and its tip at z = 1.
[[nodiscard]] SolidMesh makeConeMesh(int segments);

}  // namespace rex::internal
