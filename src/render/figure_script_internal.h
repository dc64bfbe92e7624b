#pragma once

#include <string>

#include "render/figure.h"

namespace rex::internal {

/// The gnuplot commands that draw `figure` to standard output with `terminal`, "pngcairo" or "svg". Throws
/// Error as writeFigure() for a figure that cannot be drawn.
[[nodiscard]] std::string figureScript(const Figure& figure, const std::string& terminal);

}  // namespace rex::internal
