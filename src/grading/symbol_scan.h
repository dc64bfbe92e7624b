#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grading/compiler_messages.h"
#include "grading/exercise_info.h"

namespace rex::grading {

/// The forbidden functions that an object file calls, whatever their arguments, from what `nm -C` prints
/// about it: its undefined symbols and the inline ones it brings along.
[[nodiscard]] std::vector<ForbiddenFunction> forbiddenCalls(std::string_view symbols,
                                                            const std::vector<ForbiddenFunction>& forbidden);

/// Runs nm on an object file and explains each forbidden call as an error of rule "forbidden-call", at the
/// first line of `source` that names the function. Throws Error when nm cannot read the file.
[[nodiscard]] std::vector<CompileDiagnostic> scanSymbols(const std::string& nm,
                                                         const std::filesystem::path& object,
                                                         std::string_view source, const std::string& mainFile,
                                                         const std::vector<ForbiddenFunction>& forbidden);

}  // namespace rex::grading
