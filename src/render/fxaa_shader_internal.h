#pragma once

#include "render/shaders_internal.h"

namespace rex::internal {

/// Smooths the steps of slanted edges by what a picture's colours tell about them (the idea of FXAA, T.
/// Lottes 2009). Reads sampler `drawn`, is drawn over a copy of it, and leaves alone where there is no edge.
[[nodiscard]] ShaderSource fxaaShader();

}  // namespace rex::internal
