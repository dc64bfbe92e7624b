#pragma once

#include "estimation/occupancy_map.h"

namespace rex::internal {

/// Throws Error unless all angles of the scanner are finite and its largest range is finite and positive.
void requireScanner(const RangeScanner& scanner);

/// Throws Error unless the scanner is sound, and ranges are finite, not negative, and one for each ray.
void requireRanges(const RangeScanner& scanner, const VectorArg& ranges);

}  // namespace rex::internal
