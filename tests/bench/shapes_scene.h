#pragma once

#include <vector>

#include "render/camera.h"
#include "render/picture.h"

namespace rex::bench {

/// 28 capsules, 12 spheres and 20 boxes above the ground, and a camera that sees them; the same numbers for
/// rex and for its peer.
[[nodiscard]] std::vector<Solid> sixtyShapes();
struct View {
  Eigen::Vector3d eye{2.6, -2.6, 2.0}, target{0, 0, 0.6};
  double verticalFovDegrees = 45;
};

/// Of a frame in pixels, each of four samples, with shadows.
struct FrameSize {
  int width = 640, height = 480;
};

}  // namespace rex::bench
