#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"

namespace rex::grading {

/// What in a source would make the compiler speak of other files or lines than its own, or be silent as in a
/// header of the system: #line, "# 1", and the pragma for system headers, however they are spelt. Each is an
/// error of rule "line-marker" at its line. A comment is passed over only where it begins its line and the
/// source has no raw string, since in all other places two readers of C++ could differ about it.
[[nodiscard]] std::vector<CompileDiagnostic> lineMarkers(std::string_view source,
                                                         const std::string& mainFile);

}  // namespace rex::grading
