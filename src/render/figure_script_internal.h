#pragma once

#include <string>

#include "render/figure.h"

namespace rex::internal {

/// Throws Error as writeFigure() for a figure that cannot be drawn.
void requireDrawable(const Figure& figure);

/// The gnuplot commands that draw `figure` to standard output with `terminal`, "pngcairo" or "svg".
[[nodiscard]] std::string figureScript(const Figure& figure, const std::string& terminal);

}  // namespace rex::internal
