#pragma once

#include <string_view>

#include "render/color.h"
#include "render/image.h"

namespace rex {

/// Size of a text in pixels. Capitals are 9 * scale high; `height` is one line with its spacing.
struct TextSize {
  int width = 0, height = 0;
};
[[nodiscard]] TextSize textSize(std::string_view text, double scale = 1);

/// Draws one line of UTF-8 text in DejaVu Sans, its top left corner at pixel (x, y), with a light or dark
/// halo that keeps it readable on any background. Parts outside the image are cut off. Throws Error if the
/// font (fonts-dejavu-core) is not installed.
void drawText(Image& image, std::string_view text, int x, int y, const Color& color, double scale = 1);

}  // namespace rex
