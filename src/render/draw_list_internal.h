#pragma once

#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/picture.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {

enum class MeshKind { kBox, kCapsule, kCylinder, kRoundedBox, kCone, kImported };

/// A mesh put into the world: a unit mesh, see MeshVertex, or some triangles of an imported one as they are.
struct DrawItem {
  MeshKind mesh = MeshKind::kBox;
  std::size_t detail = 0;  ///< which of kSegments
  Pose X_WS{};
  Eigen::Vector3d halfSize{1, 1, 1};
  Eigen::Vector3d stretch{0, 0, 0};
  Color color{};
  int solid = -1;  ///< its index in the picture; -1 for what is not a solid
  TriangleMesh imported{};
  std::uint32_t firstTriangle = 0, triangleCount = 0;  ///< of `imported`
  std::optional<std::uint32_t> texture{};              ///< of its paint; times `color`
};

/// The largest radius of what is round about it, metres.
[[nodiscard]] double radiusOf(const DrawItem& item);
/// Half edge lengths of the box about the origin and along the axes of S that holds the item, metres.
[[nodiscard]] Eigen::Vector3d halfExtent(const DrawItem& item);

/// What the solid passes draw: opaque items in the order of the picture, then the translucent ones from far
/// to near. Markers and points are not solid (see OverlayVertex), things without extent or colour are left
/// out.
struct DrawList {
  std::vector<DrawItem> opaque;
  std::vector<DrawItem> translucent;
};

[[nodiscard]] DrawList makeDrawList(const Picture& picture, const Camera& camera, int pictureHeight);

}  // namespace rex::internal
