#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace rex {

/// A picture of width x height pixels, 8 bits each of red, green, blue (sRGB); rows from the top, no padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb{};

  Image() = default;
  /// A black picture. Throws Error unless both sizes are at least 1.
  Image(int imageWidth, int imageHeight);

  /// The three bytes of pixel (x, y); (0, 0) is the top left one. The pixel must exist.
  [[nodiscard]] std::uint8_t* pixel(int x, int y);
  [[nodiscard]] const std::uint8_t* pixel(int x, int y) const;
  [[nodiscard]] std::array<int, 3> at(int x, int y) const;

  bool operator==(const Image&) const = default;
};

}  // namespace rex
