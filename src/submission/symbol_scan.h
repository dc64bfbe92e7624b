#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/build_tools.h"
#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"

namespace rex::grading {

/// The forbidden functions that an object file refers to outside main() and what is declared in it, whatever
/// their arguments, from what `objdump -t -r -C` prints about it. main() may call them, to compare a
/// student's work with the library's: the grader never runs it. If anything else refers to main(), all its
/// calls count. Functions that find others by name, as dlsym(), count always. Needs a file compiled with
/// -ffunction-sections.
[[nodiscard]] std::vector<ForbiddenFunction> forbiddenCalls(std::string_view listing,
                                                            const std::vector<ForbiddenFunction>& forbidden);

/// Runs objdump on an object file and explains each forbidden call as an error of rule "forbidden-call", at
/// the line of `source` that names the function if there is only one outside main(). Throws Error when
/// objdump cannot read the file.
[[nodiscard]] std::vector<CompileDiagnostic> scanSymbols(const std::string& objdump,
                                                         const std::filesystem::path& object,
                                                         std::string_view source, const std::string& mainFile,
                                                         const std::vector<ForbiddenFunction>& forbidden,
                                                         const BuildTools& tools);

}  // namespace rex::grading
