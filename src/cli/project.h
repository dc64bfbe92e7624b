#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::cli {

using grading::ExerciseInfo;

/// The absolute folders of the project and its build.
struct Project {
  std::filesystem::path root;
  std::filesystem::path build;

  /// All exercises, by name. Throws Error for a bad exercise.toml.
  [[nodiscard]] std::vector<ExerciseInfo> exercises() const;
  /// The exercise of that name, number or topic. Throws UsageError naming the nearest.
  [[nodiscard]] ExerciseInfo exercise(std::string_view name) const;
  /// The build's folder of an exercise: grader, worker object, build.json.
  [[nodiscard]] std::filesystem::path buildFolder(const ExerciseInfo& exercise) const;
  /// The default folder for results of an exercise; those of the reference solution have their own.
  [[nodiscard]] std::filesystem::path outFolder(const ExerciseInfo& exercise, bool solution) const;
};

/// The path as a user in the current folder would type it.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// How to build and grade student code of an exercise; first builds what that needs. Throws like
/// bringUpToDate() and readToolchain().
[[nodiscard]] grading::Toolchain prepare(const Project& project, const ExerciseInfo& exercise);

}  // namespace rex::cli
