#pragma once

#include "render/gl_context.h"

namespace rex {

/// Where a student's program takes OpenGL from: what REX_GL in the environment names, or what works. A
/// program of a student has no other edge at which to choose. Throws Error naming the choices.
[[nodiscard]] GlOptions glChoice();

}  // namespace rex
