#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/gl_context.h"

namespace rex::internal {

/// The libraries of each backend, tried in order.
struct GlLibraries {
  std::vector<std::string> osMesa, egl;
};

/// makeGlContext() with these libraries. Throws Error telling the cause of each backend that was tried.
[[nodiscard]] std::unique_ptr<GlContext> makeContextFrom(const GlLibraries& libraries,
                                                         const GlOptions& options);

/// File names of the EGL library, tried in this order.
[[nodiscard]] std::vector<std::string> eglLibraries();

/// A context of the first of `libraries` that can be loaded, on Mesa's display without a screen. Throws Error
/// naming the Debian packages, and where it is not in software, or not by a graphics card if `wantsCard`.
[[nodiscard]] std::unique_ptr<GlContext> makeEglContext(const std::vector<std::string>& libraries,
                                                        bool wantsCard);

/// File names of the OSMesa library, tried in this order.
[[nodiscard]] std::vector<std::string> osMesaLibraries();

/// A context of the first of `libraries` that can be loaded. Throws Error naming the Debian package.
[[nodiscard]] std::unique_ptr<GlContext> makeOsMesaContext(const std::vector<std::string>& libraries);

}  // namespace rex::internal
