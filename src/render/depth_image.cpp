#include "render/depth_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

using Rgb = std::array<double, 3>;

constexpr Rgb kNothing = {236, 238, 240};
// From near to far, each darker by the same step when seen in grey.
constexpr std::array<Rgb, 6> kScale = {
    {{250, 226, 70}, {129, 208, 94}, {46, 166, 133}, {43, 117, 142}, {57, 72, 135}, {48, 18, 77}}};

Rgb onScale(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kScale.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  const double rest = place - static_cast<double>(i);
  Rgb color;
  for (std::size_t c = 0; c < 3; ++c) color[c] = (1 - rest) * kScale[i][c] + rest * kScale[i + 1][c];
  return color;
}

}  // namespace

float DepthImage::at(int x, int y) const {
  assert(x >= 0 && x < width && y >= 0 && y < height);
  return metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
}

Image depthColors(const DepthImage& depth, double nearest, double farthest) {
  if (!(nearest > 0 && farthest > nearest && std::isfinite(farthest)))
    throw Error({.what = "depth colours",
                 .found = fmt::format("from {} m to {} m", nearest, farthest),
                 .wanted = "0 < nearest < farthest"});
  Image image(depth.width, depth.height);
  std::uint8_t* to = image.rgb.data();
  for (const float metres : depth.metres) {
    const Rgb color =
        std::isfinite(metres) ? onScale((1 / nearest - 1 / metres) / (1 / nearest - 1 / farthest)) : kNothing;
    for (const double part : color) *to++ = static_cast<std::uint8_t>(std::lround(part));
  }
  return image;
}

Image depthColors(const DepthImage& depth) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const double metres : depth.metres) {
    if (!std::isfinite(metres)) continue;
    nearest = std::min(nearest, metres);
    farthest = std::max(farthest, metres);
  }
  // If there is no depth, or only one, any range will do.
  if (nearest > farthest) nearest = 1;
  return depthColors(depth, nearest, farthest > nearest ? farthest : nearest + 1);
}

}  // namespace rex
