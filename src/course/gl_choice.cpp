#include "course/gl_choice.h"

#include <cstdlib>

namespace rex {

GlOptions glChoice() {
  const char* name = std::getenv("REX_GL");
  const bool isChosen = name != nullptr && *name != '\0';
  return {.backend = isChosen ? glBackendFromName(name) : GlBackend::kAuto};
}

}  // namespace rex
