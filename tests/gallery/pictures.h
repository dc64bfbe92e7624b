#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/image.h"

namespace rex::gallery {

inline constexpr int kSlideWidth = 1280, kSlideHeight = 960;  ///< of a picture as wide as a slide, pixels

/// One picture of the gallery: its file is NAME.png.
struct Drawing {
  std::string name;
  std::string title;
  std::string text;  ///< what it shows, one paragraph
  std::function<Image()> draw;
};

/// The pictures in space, in the order of the page.
[[nodiscard]] std::vector<Drawing> pictures();

}  // namespace rex::gallery
