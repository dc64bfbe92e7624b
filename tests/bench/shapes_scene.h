#pragma once

#include <vector>

#include "render/camera.h"
#include "render/picture.h"

namespace rex::bench {

/// 28 capsules, 12 spheres and 20 boxes above the ground, or every second of them, and a camera that sees
/// them; the same numbers for rex and for its peer.
[[nodiscard]] std::vector<Solid> sixtyShapes();
[[nodiscard]] std::vector<Solid> thirtyShapes();
struct View {
  Eigen::Vector3d eye{2.6, -2.6, 2.0}, target{0, 0, 0.6};
  double verticalFovDegrees = 45;
};

/// What a frame is like.
struct FrameKind {
  int shapes = 60;  ///< or 30
  int width = 640, height = 480;
  int samples = 4;  ///< per pixel, or 1
  bool shadow = true;
};

}  // namespace rex::bench
