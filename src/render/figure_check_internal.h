#pragma once

#include <string>

#include "render/figure.h"

namespace rex::internal {

/// "figure 'TITLE'", for messages.
[[nodiscard]] std::string nameOf(const Figure& figure);

/// Whether the figure is drawn over three axes.
[[nodiscard]] bool inSpace(const Figure& figure);

/// Whether the figure needs a colour bar.
[[nodiscard]] bool hasColorBar(const Figure& figure);

/// Throws Error as writeFigure() for labels, sizes and numbers that cannot be drawn.
void requireDrawable(const Figure& figure);

}  // namespace rex::internal
