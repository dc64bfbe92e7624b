#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "authoring/leak_scan.h"

namespace rex::authoring {

/// The contents of a student release, from which packages are built, and the result of its scan.
struct Release {
  int exercises = 0;
  LeakScan scan{};                ///< if it has leaks, the release was removed
  std::vector<Secret> secrets{};  ///< the secrets that the scan searched for
};

/// Writes the tree that packages for students are built from to `target`: all of `root` that builds and runs;
/// exercises (those named by `only`, or all) without submission::isForLecturers(), with main.cpp and
/// its copy starter.cpp remade from the solution, and check.cpp without hidden blocks; no tests, history or
/// results. Finally scans it for leaks of all exercises, also of the secret of the course if that file is
/// given; helpers of checks are no leak there. Throws UsageError if the target is not empty, and Error,
/// leaving nothing behind, for malformed markers and files that cannot be read or written.
[[nodiscard]] Release writeStudentRelease(const std::filesystem::path& root,
                                          const std::filesystem::path& target,
                                          const std::filesystem::path& courseSecret = {},
                                          const std::vector<std::string>& only = {});

/// The secrets in `root` that must not reach students: see collectSecrets().
[[nodiscard]] std::vector<Secret> secretsOfCourse(const std::filesystem::path& root,
                                                  const std::filesystem::path& courseSecret = {});

/// Throws Error (file:line) if a text file of the exercise, as students would get it, contains one of its
/// secrets.
void requireNoSolutionText(const std::filesystem::path& exercise);

}  // namespace rex::authoring
