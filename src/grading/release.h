#pragma once

#include <filesystem>

namespace rex::grading {

/// Writes to `target` the tree that students get: all of `root` that builds and runs, exercises without
/// solution.cpp and wrong/, their main.cpp and its copy starter.cpp made afresh from the solution, check.cpp
/// without hidden blocks; no tests, no history, no results. Throws UsageError when the target holds anything
/// already, and Error, leaving nothing behind, for malformed markers and when any file outside src would hold
/// a line of a solution.
void writeStudentRelease(const std::filesystem::path& root, const std::filesystem::path& target);

/// Throws Error (file:line) when a text file of the exercise, as students would get it, holds a line that
/// only the solution has.
void requireNoSolutionText(const std::filesystem::path& exercise);

}  // namespace rex::grading
