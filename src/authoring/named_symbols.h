#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace rex::grading {

/// A name that does not exist.
struct DeadName {
  SourceLocation where;
  std::string name;
  std::vector<std::string> nearest;
};

/// Names in backticks in an exercise's README.md and in the TODO lines of its solution.cpp that do not
/// exist: neither as a file of the exercise or project, nor as a word of code in exercise.h, main.cpp,
/// show.h, show.cpp or a header below root/src. Formulas, numbers, paths in out/ and names in std:: and
/// Eigen:: are ignored. Also functions that exercise.toml forbids but that occur in no header below
/// root/src.
[[nodiscard]] std::vector<DeadName> deadNames(const std::filesystem::path& root,
                                              const std::filesystem::path& exercise);

}  // namespace rex::grading
