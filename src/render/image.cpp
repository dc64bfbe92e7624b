#include "render/image.h"

#include <cassert>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {

Image::Image(int imageWidth, int imageHeight) : width(imageWidth), height(imageHeight) {
  if (width < 1 || height < 1)
    throw Error({.what = "image size",
                 .found = fmt::format("{} x {}", width, height),
                 .wanted = "at least 1 x 1 pixels"});
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

std::uint8_t* Image::pixel(int x, int y) {
  return const_cast<std::uint8_t*>(static_cast<const Image&>(*this).pixel(x, y));
}

const std::uint8_t* Image::pixel(int x, int y) const {
  assert(x >= 0 && x < width && y >= 0 && y < height);
  return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x);
}

std::array<int, 3> Image::at(int x, int y) const {
  const std::uint8_t* p = pixel(x, y);
  return {p[0], p[1], p[2]};
}

}  // namespace rex
