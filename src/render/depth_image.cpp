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

namespace {

using SegmentColor = std::array<std::uint8_t, 3>;

// Hues that differ for any number of neighbours (steps of the golden ratio), in five kinds. Hues come close
// to each other again after 5, 8, 13, 21 ... steps, of which 5 is the first between ids of one kind.
SegmentColor colorOf(std::int32_t id) {
  if (id == SegmentationImage::kGround) return {176, 180, 186};
  if (id < 0) return {245, 246, 247};
  constexpr double kGolden = 0.6180339887498949;
  constexpr std::array<double, 5> kBrightness = {0.88, 0.60, 0.97, 0.74, 0.45};
  constexpr std::array<double, 5> kSaturation = {0.75, 0.80, 0.42, 0.50, 0.70};
  const double hue = 6 * std::fmod(0.58 + kGolden * id, 1.0);
  const std::size_t kind = static_cast<std::size_t>(id) % kBrightness.size();
  SegmentColor color;
  for (std::size_t c = 0; c < 3; ++c) {
    // The distance on the circle of hues from red, green or blue.
    const double away = std::abs(std::remainder(hue - 2.0 * static_cast<double>(c), 6.0));
    const double pure = std::clamp(2.0 - away, 0.0, 1.0);
    color[c] = static_cast<std::uint8_t>(255 * kBrightness[kind] * (1 - kSaturation[kind] * (1 - pure)));
  }
  return color;
}

}  // namespace

std::int32_t SegmentationImage::at(int x, int y) const {
  assert(x >= 0 && x < width && y >= 0 && y < height);
  return id[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
}

Image segmentationColors(const SegmentationImage& segmentation) {
  Image image(segmentation.width, segmentation.height);
  std::uint8_t* to = image.rgb.data();
  for (const std::int32_t id : segmentation.id)
    for (const std::uint8_t part : colorOf(id)) *to++ = part;
  return image;
}

}  // namespace rex
