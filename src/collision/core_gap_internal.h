#pragma once

#include "collision/minkowski_difference_internal.h"

namespace rex::internal {

/// The distance of two cores that lie apart, with a slack of 1e-10 m; more only where features of nanometres
/// blur the direction. If they touch or overlap, zero, and then only `nearest` counts: the origin if the
/// difference is flat. Gilbert, Johnson and Keerthi, 1988, with the nearest point of a simplex by trying all
/// its sides.
[[nodiscard]] CoreProximity coreGap(const MinkowskiDifference& difference);

}  // namespace rex::internal
