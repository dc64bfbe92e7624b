#pragma once

#include <string>

#include "geometry/shape.h"

namespace rex::internal {

enum class CoreType { kSegment, kBox, kOther };

/// A shape as a core swept by a ball of `radius`: a segment, half.z long to each side along z, or a box.
struct Core {
  CoreType type = CoreType::kOther;
  Eigen::Vector3d half{0, 0, 0};
  double radius = 0;
};

/// kOther: a cylinder, a cone, or a shape described by a mesh.
[[nodiscard]] Core coreOf(const Shape& shape);

/// Throws Error for what cannot collide: a marker, or a shape whose mesh is not loaded. `what` begins the
/// message.
void requireSolid(const std::string& what, const Shape& shape);

}  // namespace rex::internal
