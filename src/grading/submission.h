#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grading/exercise_info.h"
#include "grading/results.h"
#include "grading/toolchain.h"

namespace rex::grading {

/// What to grade and where to keep the result.
struct SubmissionOptions {
  std::filesystem::path main;        ///< the student's file
  std::filesystem::path workFolder;  ///< for objects and the worker; two gradings need two
  std::filesystem::path results;     ///< results.json; build.log is written beside it
  std::vector<std::string> checks;   ///< ids; empty: all
  std::optional<std::uint64_t> seed;
};

/// A graded file.
struct Submission {
  GradeResult result;
  std::string source;  ///< what was compiled; empty if the file was refused
};

/// Compiles the file, has the exercise's grader check it and leaves results.json, whatever the file does. A
/// file that does not compile, or calls what is forbidden, gets Outcome::compileError. Throws Error for an
/// unknown check, or when the grader or the tools cannot be run.
[[nodiscard]] Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                         const SubmissionOptions& options);

/// All checks of an exercise, none run. Throws Error when the grader cannot list them.
[[nodiscard]] std::vector<CheckResult> listChecks(const Toolchain& toolchain);

}  // namespace rex::grading
