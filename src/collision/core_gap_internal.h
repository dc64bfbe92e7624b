#pragma once

#include "collision/core_difference_internal.h"

namespace rex::internal {

/// The distance of two cores that lie apart, with a slack of 1e-10 m. If they touch or overlap, a distance
/// that is not positive, with a slack that says nothing; `nearest` then is the origin if the difference is
/// flat. Gilbert, Johnson and Keerthi, 1988, with the nearest point of a simplex by trying all its sides.
[[nodiscard]] CoreProximity coreGap(const CoreDifference& difference);

}  // namespace rex::internal
