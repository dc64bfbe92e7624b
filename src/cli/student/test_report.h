#pragma once

#include <filesystem>

#include "cli/project.h"
#include "submission/submission.h"

namespace rex::cli {

/// Prints the result for people: each check with its points and, if it failed, what was wanted and what
/// came out; also what the last run left in the folder of `results`, and how to repeat one check.
/// `isWhole`: all existing checks were graded.
void printResult(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& results, bool isWhole);

}  // namespace rex::cli
