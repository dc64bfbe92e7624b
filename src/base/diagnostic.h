#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace rex {

/// A warning points to a likely mistake; a note only informs.
enum class Severity { kNote, kWarning };

/// Something that a reader noticed and tolerated: the file loads, but the user should know.
struct Diagnostic {
  SourceLocation where;
  std::string message;
  Severity severity = Severity::kNote;
};

using Diagnostics = std::vector<Diagnostic>;

/// "file:line:column: note: message", or "warning".
[[nodiscard]] std::string toString(const Diagnostic& diagnostic);

}  // namespace rex
