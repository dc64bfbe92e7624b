#pragma once

#include <vector>

#include "render/camera.h"
#include "render/picture.h"
#include "render/solid_mesh_internal.h"

namespace rex::internal {

enum class MeshKind { kBox, kCapsule, kCylinder };

/// A unit mesh put into the world; see MeshVertex.
struct DrawItem {
  MeshKind mesh = MeshKind::kBox;
  std::size_t detail = 0;  ///< which of kSegments
  Pose X_WS{};
  Eigen::Vector3d halfSize = Eigen::Vector3d::Ones();
  double stretch = 0;
  Color color{};
  int solid = -1;  ///< its index in the picture; -1 for what is no solid
};

/// The radius about its z axis, metres.
[[nodiscard]] double radiusOf(const DrawItem& item);

/// What the solid passes draw: opaque items in the order of the picture, then the translucent ones from far
/// to near. Markers are not solid (see overlayLines), things without extent or colour are left out.
struct DrawList {
  std::vector<DrawItem> opaque;
  std::vector<DrawItem> translucent;
};

[[nodiscard]] DrawList makeDrawList(const Picture& picture, const Camera& camera, int pictureHeight);

/// All lines of the picture: its polylines, its axes and its marker shapes.
[[nodiscard]] std::vector<Polyline> overlayLines(const Picture& picture);

}  // namespace rex::internal
