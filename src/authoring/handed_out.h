#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::authoring {

/// What the project `root` still lacks before this exercise can be handed out to everybody, one line each:
/// questions and notes on them, the lines of the exercise in the documents and CI files of the course, and
/// the number of exercises in README.md, which does not count private ones. The gate handed-out is:
///   missingDescriptions(root, exercise).empty()
[[nodiscard]] std::vector<std::string> missingDescriptions(const std::filesystem::path& root,
                                                           const submission::ExerciseInfo& exercise);

}  // namespace rex::authoring
