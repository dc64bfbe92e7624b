#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

/// Finds what would make the compiler report other files or lines, or suppress messages as in a system
/// header: #line, "# 1", and the pragma for system headers, however they are spelt. Each is an error with
/// the rule "line-marker" at its line; of too many, only the first are named. Comments are skipped only if
/// they begin a line and the source has no raw string, because elsewhere two C++ parsers could disagree about
/// them: so this is the one reader that does not use CppText. Takes time in proportion to the source.
[[nodiscard]] std::vector<CompileDiagnostic> lineMarkers(std::string_view source,
                                                         const std::string& mainFile);

}  // namespace rex::grading
