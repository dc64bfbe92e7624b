#pragma once

#include "render/image.h"

namespace rex {

/// The image at `width` pixels, its shape kept: each new pixel is the mean of the area it covers. An image
/// that is not wider than that comes back as it is. Throws Error for a width below 1.
[[nodiscard]] Image shrunk(const Image& image, int width);

}  // namespace rex
