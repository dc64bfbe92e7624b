#pragma once

#include <vector>

#include "render/image.h"

namespace rex {

/// What a depth camera sees: metres before the camera along its axis, infinity where there is nothing. Rows
/// from the top, no padding.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> metres{};

  /// Of pixel (x, y); (0, 0) is the top left one. The pixel must exist.
  [[nodiscard]] float at(int x, int y) const;

  bool operator==(const DepthImage&) const = default;
};

/// The depths for people: `nearest` metres is bright yellow, `farthest` dark blue, with even steps of 1 /
/// depth between them, and nothing light grey. Throws Error for an image without pixels and unless 0 <
/// nearest < farthest.
[[nodiscard]] Image depthColors(const DepthImage& depth, double nearest, double farthest);
/// The same from the least to the largest finite depth of the image.
[[nodiscard]] Image depthColors(const DepthImage& depth);

}  // namespace rex
