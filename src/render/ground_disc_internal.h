#pragma once

#include <optional>

#include "render/camera.h"
#include "render/picture.h"

namespace rex::internal {

/// The part of the ground that is drawn: to its rim it has faded out. Metres, in W.
struct GroundDisc {
  Eigen::Vector3d center;
  double radius;
};

/// None for a picture without ground or with one of its own, see checkerHeight(), and for a camera not above
/// it.
[[nodiscard]] std::optional<GroundDisc> visibleGround(const Picture& picture, const Camera& camera);

}  // namespace rex::internal
