#pragma once

#include "render/gl_context.h"

namespace rex {

/// The OpenGL implementation for a student's program: the one named by REX_GL in the environment, or else
/// any that works. Such a program has no command line on which to choose. Throws Error naming the choices.
[[nodiscard]] GlOptions glChoice();

}  // namespace rex
