#pragma once

#include <vector>

#include "render/figure_axes_internal.h"

namespace rex::internal {

/// The corner in which the legend hides least of the traces; the top right one where all are alike.
[[nodiscard]] Legend emptiestCorner(const Figure& figure, const std::vector<Trace>& traces,
                                    const FigureAxes& axes);

}  // namespace rex::internal
