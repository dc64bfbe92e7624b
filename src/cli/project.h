#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::cli {

using grading::ExerciseInfo;

/// Where the project and its build lie; absolute.
struct Project {
  std::filesystem::path root;
  std::filesystem::path build;

  /// All exercises, by name. Throws Error for a bad exercise.toml.
  [[nodiscard]] std::vector<ExerciseInfo> exercises() const;
  /// The exercise of that name, number or topic. Throws UsageError naming the nearest.
  [[nodiscard]] ExerciseInfo exercise(std::string_view name) const;
  /// What the build keeps about an exercise: grader, worker object, build.json.
  [[nodiscard]] std::filesystem::path buildFolder(const ExerciseInfo& exercise) const;
  /// Where results of an exercise go unless the user says otherwise; those of the reference solution apart.
  [[nodiscard]] std::filesystem::path outFolder(const ExerciseInfo& exercise, bool solution) const;
};

/// The path as a user in the current folder would type it.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// How to build and grade student code of an exercise; brings what that needs up to date first. Throws
/// BuildFailure as bringUpToDate(), and as readToolchain() does.
[[nodiscard]] grading::Toolchain prepare(const Project& project, const ExerciseInfo& exercise);

}  // namespace rex::cli
