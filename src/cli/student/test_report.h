#pragma once

#include <filesystem>

#include "cli/project.h"
#include "submission/submission.h"

namespace rex::cli {

/// Prints a graded file for people: each check with its points and, where it did not pass, what was wanted
/// and what came; what the last run left in the folder of `results`, and how to repeat one check. `isWhole`:
/// all checks that there are were graded.
void printResult(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& results, bool isWhole);

}  // namespace rex::cli
