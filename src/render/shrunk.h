#pragma once

#include "render/image.h"

namespace rex {

/// The image scaled down to `width` pixels with its aspect ratio kept: each new pixel is the mean of the
/// area it covers. An image that is not wider is returned unchanged. Throws Error for a width below 1.
[[nodiscard]] Image shrunk(const Image& image, int width);

}  // namespace rex
