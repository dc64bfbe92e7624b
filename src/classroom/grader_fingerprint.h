#pragma once

#include <filesystem>
#include <string>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// Hash of what grades an exercise here: its description, its grader, the compiler and flags for students'
/// files, the headers that they may include, the library that they are linked to, the program that runs now,
/// which compiles and refuses, and the launcher of the sandbox where there is one. Throws Error when a file
/// of these cannot be read.
[[nodiscard]] std::string graderFingerprint(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                            const std::filesystem::path& launcher);

}  // namespace rex::grading
