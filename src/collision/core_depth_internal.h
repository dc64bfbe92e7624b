#pragma once

#include "collision/minkowski_difference_internal.h"

namespace rex::internal {

/// How deep two cores overlap that touch or overlap: `touching` is a pair of common points. A polytope inside
/// of their difference grows at the side nearest to the origin, which bounds the depth from below, as every
/// gap bounds it from above (van den Bergen, 2001). The slack is 1e-10 m for cores with flat sides, 5e-7 m
/// with curved ones, as long as the corners of ExpandingPolytope suffice: about one for each direction that
/// leads out on nearly the shortest way, so 10 000 for cylinders of 3 m radius around one axis.
[[nodiscard]] CoreProximity coreDepth(const MinkowskiDifference& difference, const DifferencePoint& touching);

}  // namespace rex::internal
