#pragma once

#include <cstdint>
#include <vector>

#include "render/image.h"

namespace rex {

/// The image of a depth camera: depth in metres along the camera's axis, infinity where there is nothing.
/// Rows from the top, no padding.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> metres{};

  /// The depth at pixel (x, y); (0, 0) is the top left one. The pixel must exist.
  [[nodiscard]] float at(int x, int y) const;

  bool operator==(const DepthImage&) const = default;
};

/// The depths as colours for viewing: from bright yellow at `nearest` metres to dark blue at `farthest`,
/// linear in 1 / depth, and light grey where there is nothing. Throws Error for an image without pixels and
/// unless 0 < nearest < farthest.
[[nodiscard]] Image depthColors(const DepthImage& depth, double nearest, double farthest);
/// The same from the smallest to the largest finite depth of the image.
[[nodiscard]] Image depthColors(const DepthImage& depth);

/// The solid that each pixel shows, as its index in Picture::solids. Rows from the top, no padding.
struct SegmentationImage {
  static constexpr std::int32_t kNothing = -1;
  static constexpr std::int32_t kGround = -2;

  int width = 0;
  int height = 0;
  std::vector<std::int32_t> id{};

  /// The id at pixel (x, y); (0, 0) is the top left one. The pixel must exist.
  [[nodiscard]] std::int32_t at(int x, int y) const;

  bool operator==(const SegmentationImage&) const = default;
};

/// The ids as colours for viewing: for each solid a colour that depends on its index alone, grey for the
/// ground, almost white for nothing. Throws Error for an image without pixels.
[[nodiscard]] Image segmentationColors(const SegmentationImage& segmentation);

}  // namespace rex
