#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grading/grading_job.h"
#include "grading/results.h"
#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::submission {

/// What to grade, and how.
struct SubmissionOptions {
  std::filesystem::path main;        ///< the student's file
  std::filesystem::path workFolder;  ///< for objects and the worker; each grading needs its own
  /// Its sandbox is also used for compilers, which use as many processors as it has jobs; build.log is
  /// written next to its results. The worker, limits, libraries and temporary folder are set by the
  /// functions below.
  grading::GradingJob job{};
  bool lookAgain = false;      ///< after a crash in a visible check, find its line with the sanitizers
  bool sanitize = false;       ///< grade a build with the sanitizers, with twenty times the CPU time
  double compileSeconds = 30;  ///< of CPU time
};

/// A graded file.
struct Submission {
  grading::GradeResult result;
  std::string source;  ///< what was compiled; empty if the file was rejected
};

/// Compiles the file, has the exercise's grader check it and writes results.json, whatever the file does. A
/// file that does not compile or calls forbidden functions gets Outcome::kCompileError; if the grader or the
/// tools fail, the outcome is Outcome::kGraderError. Throws Error for an unknown check.
[[nodiscard]] Submission gradeSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                         const SubmissionOptions& options);

/// The first of the two steps of gradeSubmission(): the result of compiling, and the worker if there is
/// one.
struct BuiltSubmission {
  grading::GradeResult start;  ///< the result before any check has run
  std::string source;
  std::filesystem::path worker;      ///< empty: the file does not compile, or the tools failed
  std::vector<std::string> parts{};  ///< with workers of their own: see workerProgram()
};
[[nodiscard]] BuiltSubmission buildSubmission(const Toolchain& toolchain, const ExerciseInfo& exercise,
                                              const SubmissionOptions& options);

/// The second step, which may be repeated with other seeds. For the second pass of a job, `built.start` is
/// the result of the first.
[[nodiscard]] grading::GradeResult gradeBuilt(const BuiltSubmission& built, const Toolchain& toolchain,
                                              const ExerciseInfo& exercise, const SubmissionOptions& options);

/// Where the exercise in that folder keeps its grading::KnownMistakes, if it has any.
[[nodiscard]] std::filesystem::path knownMistakesFile(const std::filesystem::path& folder);

/// Twelve digits that change whenever the exercise in that folder or its checks change.
[[nodiscard]] std::string exerciseVersion(const std::filesystem::path& folder);

/// All checks of an exercise, not run. Throws Error if the grader cannot list them.
[[nodiscard]] std::vector<grading::CheckResult> listChecks(const Toolchain& toolchain);

}  // namespace rex::submission
