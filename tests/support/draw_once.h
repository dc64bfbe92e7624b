#pragma once

#include "render/renderer.h"

namespace rex {

/// Draws one picture from the default view with a renderer made for it.
inline Image drawOnce(const Picture& picture, const RendererOptions& options = {}) {
  const double aspect = static_cast<double>(options.width) / options.height;
  return Renderer(options).draw(picture, framing(bounds(picture), kDefaultView, aspect));
}

}  // namespace rex
