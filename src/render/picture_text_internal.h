#pragma once

#include "render/camera.h"
#include "render/image.h"
#include "render/picture.h"

namespace rex::internal {

/// Writes the picture's labels, names of axes and captions into its rendered image.
void drawPictureText(Image& image, const Picture& picture, const Camera& camera);

}  // namespace rex::internal
