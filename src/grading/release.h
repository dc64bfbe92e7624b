#pragma once

#include <filesystem>

namespace rex::grading {

/// Writes to `target` the tree that students get: all of `root` that builds and runs, exercises without
/// solution.cpp and wrong/, their main.cpp made afresh from the solution, check.cpp without hidden blocks; no
/// tests, no history, no results. Throws Error when the target holds anything already, for malformed
/// markers, and when a released file of an exercise would hold a line of its solution.
void writeStudentRelease(const std::filesystem::path& root, const std::filesystem::path& target);

/// Throws Error (file:line) when main.cpp, check.cpp or README.md of the exercise, as students would get
/// them, hold a line that only the solution has.
void requireNoSolutionText(const std::filesystem::path& exercise);

}  // namespace rex::grading
