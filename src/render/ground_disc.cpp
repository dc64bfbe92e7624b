#include <algorithm>

#include "render/ground_disc_internal.h"
#include "render/own_ground_internal.h"

namespace rex::internal {

std::optional<GroundDisc> visibleGround(const Picture& picture, const Camera& camera) {
  const Ground& plane = picture.ground;
  if (!plane.visible || camera.X_WC.p.z() <= plane.height) return std::nullopt;
  const Bounds scene = plane.scene.isEmpty() ? bounds(picture) : plane.scene;
  const std::optional<double> height = checkerHeight(picture, scene);
  if (!height) return std::nullopt;
  const Eigen::Vector3d middle = scene.isEmpty() ? Eigen::Vector3d::Zero() : scene.center();
  const double radius = scene.isEmpty() ? 1 : scene.radius();
  return GroundDisc{{middle.x(), middle.y(), *height}, std::max(6 * radius, 4 * plane.cell)};
}

}  // namespace rex::internal
