#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace rex {

/// Something a reader noticed and could live with: the file loads, but the user should know.
struct Diagnostic {
  SourceLocation where;
  std::string message;
};

using Diagnostics = std::vector<Diagnostic>;

/// "file:line:column: note: message".
[[nodiscard]] std::string toString(const Diagnostic& diagnostic);

}  // namespace rex
