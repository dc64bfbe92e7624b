#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/gl_context.h"

namespace rex::internal {

/// File names of the EGL library, tried in this order.
[[nodiscard]] std::vector<std::string> eglLibraries();

/// A context of the first of `libraries` that can be loaded, on Mesa's display without a screen. Throws Error
/// naming the Debian packages, and for a graphics card's driver unless `allowHardware`.
[[nodiscard]] std::unique_ptr<GlContext> makeEglContext(const std::vector<std::string>& libraries,
                                                        bool allowHardware);

}  // namespace rex::internal
