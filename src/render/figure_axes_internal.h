#pragma once

#include <vector>

#include "render/figure_script_internal.h"

namespace rex::internal {

/// An axis as it is drawn, with a tic at every multiple of `step`, or every `step`-fold on a logarithmic one.
struct Axis {
  double low = 0;
  double high = 1;
  double step = 0;  ///< 0: where gnuplot likes
};

/// Where along the axis `value` lies: 0 at its low end, 1 at its high end.
[[nodiscard]] double shareOf(const Axis& axis, double value, bool logarithmic);

struct FigureAxes {
  Axis x{}, y{}, z{}, color{};
};

/// The axes of a drawable figure. What has no range spans the data, up to a tic where one is near, with a
/// small margin otherwise, but no heat map or map is surrounded by white. There are as many tics as the size
/// of the figure has room for.
[[nodiscard]] FigureAxes axesOf(const Figure& figure, const std::vector<Trace>& traces);

/// The corner in which the legend hides least of the traces; the top right one where all are alike.
[[nodiscard]] Legend emptiestCorner(const Figure& figure, const std::vector<Trace>& traces,
                                    const FigureAxes& axes);

/// Throws Error unless something of the traces lies within the ranges of the figure, lines between points and
/// the inside of areas included. Expects finite data, positive on logarithmic axes.
void requireDataInView(const Figure& figure, const std::vector<Trace>& traces);

}  // namespace rex::internal
