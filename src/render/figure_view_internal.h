#pragma once

#include <vector>

#include "render/figure_trace_internal.h"

namespace rex::internal {

/// Throws Error unless something of the traces lies within the ranges of the figure, lines between points and
/// the inside of areas included. Expects finite data, positive on logarithmic axes.
void requireDataInView(const Figure& figure, const std::vector<Trace>& traces);

}  // namespace rex::internal
