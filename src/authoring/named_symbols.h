#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace rex::grading {

/// A name that leads nowhere.
struct DeadName {
  SourceLocation where;
  std::string name;
  std::vector<std::string> nearest;
};

/// Names in backticks in an exercise's README.md and in the TODO lines of its solution.cpp that do not exist:
/// neither as a file of the exercise or project, nor as a word of code in exercise.h, main.cpp, show.h or
/// show.cpp, or in a header below root/src. Formulas, numbers, paths in out/ and names of std:: and Eigen::
/// are left alone. Likewise functions that exercise.toml forbids but no header below root/src has a word for.
[[nodiscard]] std::vector<DeadName> deadNames(const std::filesystem::path& root,
                                              const std::filesystem::path& exercise);

}  // namespace rex::grading
