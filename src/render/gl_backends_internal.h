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

}  // namespace rex::internal
