#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grading/grading_job.h"
#include "grading/results.h"
#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// What to grade, and how.
struct SubmissionOptions {
  std::filesystem::path main;        ///< the student's file
  std::filesystem::path workFolder;  ///< for objects and the worker; two gradings need two
  /// Its sandbox is also that of compilers, which keep as many processors busy as it has jobs; build.log is
  /// written beside its results. Worker, limits, libraries and temporary folder are set here.
  GradingJob job{};
  bool lookAgain = false;      ///< after a crash in a visible check, find its line with the sanitizers
  bool sanitize = false;       ///< grade a build with the sanitizers, with twenty times the processor time
  double compileSeconds = 30;  ///< of processor time
};

/// A graded file.
struct Submission {
  GradeResult result;
  std::string source;  ///< what was compiled; empty if the file was refused
};

/// Compiles the file, has the exercise's grader check it and leaves results.json, whatever the file does. A
/// file that does not compile, or calls what is forbidden, gets Outcome::kCompileError; when the grader or
/// the tools fail, Outcome::kGraderError. Throws Error for an unknown check.
[[nodiscard]] Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                         const SubmissionOptions& options);

/// The first of the two steps of gradeSubmission(): what compiling said, and the worker if there is one.
struct BuiltSubmission {
  GradeResult start;  ///< what is known before any check runs
  std::string source;
  std::filesystem::path worker;  ///< empty: does not compile, or the tools failed
};
[[nodiscard]] BuiltSubmission buildSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                              const SubmissionOptions& options);

/// The second step; may be repeated with other seeds.
[[nodiscard]] GradeResult gradeBuilt(const BuiltSubmission& built, const Toolchain& toolchain,
                                     const ExerciseInfo& exercise, const SubmissionOptions& options);

/// Twelve digits that change whenever the task in that folder or its checks do.
[[nodiscard]] std::string exerciseVersion(const std::filesystem::path& folder);

/// All checks of an exercise, none run. Throws Error when the grader cannot list them.
[[nodiscard]] std::vector<CheckResult> listChecks(const Toolchain& toolchain);

}  // namespace rex::grading
