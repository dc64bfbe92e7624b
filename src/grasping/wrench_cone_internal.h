#pragma once

#include <span>

#include "grasping/wrench_cone.h"

namespace rex::internal {

/// Throws Error, naming the cone, unless all have the same size, the same number of tangents, one or two, and
/// finite numbers, of which friction is not negative.
void requireCones(std::span<const WrenchCone> cones);

}  // namespace rex::internal
