#pragma once

#include <string_view>
#include <vector>

#include "grading/compiler_messages.h"
#include "grading/exercise_info.h"

namespace rex::grading {

/// Where `rex::internal` is forbidden: an error of rule "forbidden-call" for each header "..._internal.h"
/// among the `dependencies` that the compiler wrote (g++ -MD), at the line of `source` that names it if one
/// does. What such a header holds is compiled into the student's functions, where no scan of symbols finds
/// it.
[[nodiscard]] std::vector<CompileDiagnostic> internalHeaders(std::string_view dependencies,
                                                             std::string_view source,
                                                             const std::string& mainFile,
                                                             const std::vector<ForbiddenFunction>& forbidden);

}  // namespace rex::grading
