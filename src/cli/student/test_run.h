#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "base/folders.h"
#include "cli/project.h"
#include "cli/student/check_order.h"
#include "reports/report.h"
#include "sandbox/confinement.h"
#include "submission/submission.h"

namespace rex::cli {

/// How one exercise is graded.
struct TestOptions {
  std::string exercise;
  bool solution = false;
  std::filesystem::path main;  ///< empty: the exercise's own
  grading::GradingJob job{};   ///< checks, seed and secret; the rest is set later
  bool json = false;
  bool debug = false;                     ///< with the sanitizers
  bool inFull = false;                    ///< every message, also of checks that failed the last time
  SavedFile saved{};                      ///< for checkOrder(), without the last test; empty texts: as listed
  std::filesystem::path out;              ///< empty: as for run
  std::string reports;                    ///< see parseReportFormats(): written beside the result
  std::optional<sandbox::Level> level{};  ///< empty: limits only
};

/// What publish() tells.
struct Published {
  bool isFirstWork = false;            ///< work was never recorded before: see aboutWork()
  std::vector<std::string> records{};  ///< of this test: see recordText()
};

/// One exercise in `rex test`. It works in a private folder until publish(), so that others may grade the
/// same exercise at the same time.
class TestRun {
 public:
  /// Builds what the exercise needs and makes its folders. The name of a part in the job's checks stands
  /// for all its checks. Throws UsageError and Error.
  TestRun(const Project& project, ExerciseInfo exercise, const TestOptions& options);

  [[nodiscard]] const ExerciseInfo& exercise() const { return exercise_; }
  /// Result file of the private folder.
  [[nodiscard]] std::filesystem::path ownResults() const { return work_.path() / "results.json"; }
  [[nodiscard]] const std::filesystem::path& folder() const { return work_.path(); }

  /// Grades the exercise on up to `processors` processors. Throws like gradeSubmission().
  [[nodiscard]] submission::Submission grade(const sandbox::Sandbox& sandbox, int processors = 1) const;
  /// What grade() is doing, from the growing result file.
  [[nodiscard]] std::string stage() const;
  /// Copies the result, log and evidence to the student's results folder, writes its reports there, renewing
  /// those that are there already, and notes the points, the work and the records, whose curves it draws.
  /// Throws Error if that fails.
  Published publish(const Project& project, const grading::GradeResult& result) const;
  /// Prints the table for people. Call it after publish().
  void print(const submission::Submission& graded, const Published& published) const;

 private:
  ExerciseInfo exercise_;
  TestOptions options_;
  std::filesystem::path file_, results_;
  std::optional<grading::GradeResult> before_;  // what the student's folder held
  submission::Toolchain toolchain_;
  CheckOrder order_{};  // empty: as listed
  PrivateFolder work_;
  std::vector<reports::ReportFormat> reports_;
};

/// The note that students get once in each course folder: what is recorded about their work, and where.
[[nodiscard]] std::string aboutWork();

/// What a grading is doing, from its result so far: the verdicts on what changed, then the check that runs.
[[nodiscard]] std::string stageText(const grading::GradeResult& soFar, const CheckOrder& order);

[[nodiscard]] ExitCode toExitCode(const grading::GradeResult& result);

/// What a report is about besides its result.
struct ReportView {
  bool isWhole = true;                           ///< all existing checks were graded
  bool inFull = true;                            ///< every failed check with its message, not only the first
  std::optional<grading::GradeResult> before{};  ///< of the same checks, the last time
  std::vector<std::string> records{};            ///< see Published
};

/// Prints the result for people: each check with its points and, if it failed, what was wanted and what came
/// out; what changed since the last time; what the graded functions printed, if only some checks ran; files
/// in the folder of `results` that are newer than `source`; and how to repeat one check.
void printResult(const ExerciseInfo& exercise, const submission::Submission& graded,
                 const std::filesystem::path& results, const std::filesystem::path& source,
                 const ReportView& view);

/// Grades several exercises, `jobs` at once (0: one per processor), and reports them in the given order. In
/// `each`, `out` gets a folder for every exercise; main and checks belong to a single exercise and are
/// refused. Returns the largest exit code: a grader error (also if it does not build), then not gradable,
/// then below full score.
ExitCode testMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestOptions& each,
                  int jobs);

/// Grades one exercise and prints the result.
ExitCode testOne(const Project& project, const TestOptions& options);

}  // namespace rex::cli
