#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/gl_context.h"

namespace rex::internal {

/// File names of the OSMesa library, tried in this order.
[[nodiscard]] std::vector<std::string> osMesaLibraries();

/// A context of the first of `libraries` that can be loaded. Throws Error naming the Debian package.
[[nodiscard]] std::unique_ptr<GlContext> makeOsMesaContext(const std::vector<std::string>& libraries);

}  // namespace rex::internal
