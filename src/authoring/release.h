#pragma once

#include <filesystem>
#include <vector>

#include "authoring/leak_scan.h"

namespace rex::grading {

/// What a student release holds, and what was looked for in it.
struct Release {
  int exercises = 0;
  LeakScan scan{};                ///< with leaks: nothing was left behind
  std::vector<Secret> secrets{};  ///< that the scan looked for
};

/// Writes to `target` the tree that students get: all of `root` that builds and runs, exercises without
/// solution.cpp and wrong/, their main.cpp and its copy starter.cpp made afresh from the solution, check.cpp
/// without hidden blocks; no tests, no history, no results. Looks for leaks at last, also of the secret of
/// the course in that file, if there is one. Throws UsageError when the target holds anything already, and
/// Error, leaving nothing behind, for malformed markers and what cannot be read or written.
[[nodiscard]] Release writeStudentRelease(const std::filesystem::path& root,
                                          const std::filesystem::path& target,
                                          const std::filesystem::path& courseSecret = {});

/// What must not reach students from `root`: see secretsOf().
[[nodiscard]] std::vector<Secret> secretsOfCourse(const std::filesystem::path& root,
                                                  const std::filesystem::path& courseSecret = {});

/// Throws Error (file:line) when a text file of the exercise, as students would get it, holds what it must
/// not.
void requireNoSolutionText(const std::filesystem::path& exercise);

}  // namespace rex::grading
