#include "course/gl_choice.h"

#include <cstdlib>

namespace rex {

GlOptions glChoice() {
  const char* name = std::getenv("REX_GL");
  return {.backend = name == nullptr ? GlBackend::kAuto : glBackendFromName(name)};
}

}  // namespace rex
