#pragma once

#include <filesystem>
#include <string>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// Hash of everything that grades an exercise here: its description and grader, the compiler and flags for
/// students' files, the headers they may include, the library they are linked to, the running program
/// itself, and the sandbox launcher if there is one. Throws Error if one of these files cannot be read.
[[nodiscard]] std::string graderFingerprint(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                            const std::filesystem::path& launcher);

}  // namespace rex::grading
