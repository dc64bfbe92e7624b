#pragma once

#include <vector>

#include "render/camera.h"
#include "render/image.h"
#include "render/picture.h"

namespace rex::internal {

/// Pixels of a picture: x to the right, y down.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PixelBox&) const = default;
};

/// A text of `width` x `height` pixels that wants to stand beside the point (x, y), or beside the one `lower`
/// pixels below.
struct LabelWish {
  int x = 0, y = 0;
  int width = 0, height = 0;
  int lower = 0;
};

/// A box for each wish, in their order: the first free place to the right, left, above or below the point,
/// then a little farther away. Free is what lies in the picture of `width` x `height` and meets neither a box
/// of `taken` nor one of an earlier wish. Where no place is free, the first one that lies in the picture.
[[nodiscard]] std::vector<PixelBox> placeLabels(const std::vector<LabelWish>& wishes,
                                                std::vector<PixelBox> taken, int width, int height);

/// Pixels between a text and what it stands beside.
inline constexpr int kTextMargin = 8;

/// Writes the picture's labels, names of axes and captions into its rendered image.
void drawPictureText(Image& image, const Picture& picture, const Camera& camera);

}  // namespace rex::internal
