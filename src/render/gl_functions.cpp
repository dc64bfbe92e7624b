#include <fmt/format.h>

#include "base/error.h"
#include "render/gl_functions_internal.h"

namespace rex::internal {

GlFunctions loadGlFunctions(const GlContext& context) {
  GlFunctions gl;
  std::string missing;
#define REX_GL_LOAD(name, type)                               \
  gl.name = reinterpret_cast<type>(context.proc("gl" #name)); \
  if (gl.name == nullptr) missing += missing.empty() ? "gl" #name : ", gl" #name;
  REX_GL_FUNCTIONS(REX_GL_LOAD)
#undef REX_GL_LOAD
  if (!missing.empty())
    throw Error(
        {.what = "OpenGL by " + context.describe(), .found = "no " + missing, .wanted = "OpenGL 3.3 core"});
  return gl;
}

void requireNoGlError(const GlFunctions& gl, const char* doing) {
  const GLenum code = gl.GetError();
  if (code == GL_NO_ERROR) return;
  throw Error({.what = fmt::format("OpenGL failed while {}", doing),
               .found = code == GL_OUT_OF_MEMORY ? "too little memory" : fmt::format("error {:#x}", code)});
}

}  // namespace rex::internal
