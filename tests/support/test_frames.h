#pragma once

#include <algorithm>

#include "base/rng.h"
#include "render/image.h"

namespace rex {

/// An image of one colour.
inline Image plainImage(int width, int height, std::array<int, 3> color) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(color[i % 3]);
  return image;
}

/// Noise, which nothing compresses.
inline Image noise(int width, int height, Rng& rng) {
  Image image(width, height);
  for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(rng.next());
  return image;
}

/// Frame `i` of a film: bars of strong colours above, a dark square that moves to the right below.
inline Image movingSquare(int width, int height, int i) {
  constexpr std::array<std::array<int, 3>, 4> kBars{
      {{200, 30, 40}, {30, 170, 60}, {40, 60, 200}, {230, 200, 30}}};
  Image image = plainImage(width, height, {225, 230, 235});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto& bar = kBars[static_cast<std::size_t>(4 * x / width)];
      for (int c = 0; c < 3; ++c) {
        if (y < height / 2)
          image.pixel(x, y)[c] = static_cast<std::uint8_t>(bar[static_cast<std::size_t>(c)]);
        else if (x >= 8 * i && x < 8 * i + 16 && y < height - 8)
          image.pixel(x, y)[c] = 20;
      }
    }
  }
  return image;
}

}  // namespace rex
