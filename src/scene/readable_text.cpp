#include <utility>

#include <fmt/format.h>

#include "scene/readable_text_internal.h"
#include "scene/scene_file.h"

namespace rex {

void requireReadable(const std::string& text, const std::string& ending) {
  try {
    static_cast<void>(parseScene(text, "again" + ending));
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = fmt::format("written as {}, it could not be read back: {}", ending, parts.what);
    parts.where = {};  // in a text that nobody sees
    throw Error(std::move(parts));
  }
}

}  // namespace rex
