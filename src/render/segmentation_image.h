#pragma once

#include <cstdint>
#include <vector>

#include "render/image.h"

namespace rex {

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
