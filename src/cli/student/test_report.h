#pragma once

#include <filesystem>
#include <optional>

#include "cli/project.h"
#include "submission/submission.h"

namespace rex::cli {

/// What a report is about besides its result.
struct ReportView {
  bool isWhole = true;                           ///< all existing checks were graded
  bool inFull = true;                            ///< every failed check with its message, not only the first
  std::optional<grading::GradeResult> before{};  ///< of the same checks, the last time
};

/// Prints the result for people: each check with its points and, if it failed, what was wanted and what came
/// out; what changed since the last time; what the graded functions printed, if only some checks ran; files
/// in the folder of `results` that are newer than `source`; and how to repeat one check.
void printResult(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& results, const std::filesystem::path& source,
                 const ReportView& view);

}  // namespace rex::cli
