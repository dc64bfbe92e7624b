#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
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

/// Writes an 8-bit RGB PNG. The file appears whole or not at all. Throws Error naming the path if that
/// fails, and for an image without pixels.
void writePng(const Image& image, const std::filesystem::path& path);

/// The bytes that writePng() writes. Throws Error for an image without pixels.
[[nodiscard]] std::string encodePng(const Image& image);

/// Reads any PNG of up to 100 million pixels as 8-bit RGB; transparent parts become black. Throws Error
/// naming the path and the cause.
[[nodiscard]] Image readPng(const std::filesystem::path& path);

/// The image scaled down to `width` pixels with its aspect ratio kept: each new pixel is the mean of the
/// area it covers. An image that is not wider is returned unchanged. Throws Error for a width below 1.
[[nodiscard]] Image shrunk(const Image& image, int width);

}  // namespace rex
