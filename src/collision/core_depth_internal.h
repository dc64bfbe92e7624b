#pragma once

#include "collision/core_difference_internal.h"

namespace rex::internal {

/// How deep two cores overlap that touch or overlap: `touching` is a pair of common points. A polytope inside
/// of their difference grows at the side nearest to the origin, which bounds the depth from below, as every
/// gap bounds it from above (van den Bergen, 2001). The slack is 1e-10 m for cores with flat sides, 5e-7 m
/// with curved ones, more only where hundreds of directions differ by less.
[[nodiscard]] CoreProximity coreDepth(const CoreDifference& difference, const DifferencePoint& touching);

}  // namespace rex::internal
