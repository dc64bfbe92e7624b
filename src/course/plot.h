#pragma once

#include <string>

#include "render/figure.h"
#include "render/figure_builders.h"

namespace rex {

/// Draws a figure into NAME.png and NAME.svg. Throws as writeFigure (render/figure.h).
void plot(const std::string& name, const Figure& figure);

}  // namespace rex
