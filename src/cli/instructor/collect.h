#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/gradebook.h"
#include "classroom/late_policy.h"
#include "classroom/stored_result.h"
#include "cli/instructor/class_grades.h"
#include "cli/project.h"
#include "reports/report.h"

namespace rex::cli {

/// What a run of `rex grade` did, besides the results that it left.
struct GradingSummary {
  int level = 0;                        ///< of the sandbox
  int graded = 0;                       ///< tasks; the others had a valid result
  std::vector<std::string> rejected{};  ///< complaints about what was handed in
  std::vector<std::string> blocked{};   ///< exercises whose grader does not build
};

/// The states of all tasks as JSON, "collect" of share/grading/commands.schema.json.
[[nodiscard]] std::string collectJson(const classroom::ClassRun& run);
/// The same with the summary: "grade".
[[nodiscard]] std::string gradingJson(const classroom::ClassRun& run, const GradingSummary& summary);

/// The deadlines in that file; none without a file. Throws like classroom::readLatePolicy().
[[nodiscard]] classroom::LatePolicy readDeadlines(const Project& project, const std::filesystem::path& file);

/// Processor time of a task's own process: compilers, workers and what reads the file have limits of their
/// own, so it does little itself.
inline constexpr int kSecondsOfTask = 300;

/// One line of a list of tasks, or a chunk of lines.
struct GradeOneOptions {
  std::filesystem::path manifest{};
  int task = 0;          ///< from 1; with chunks of 20: the second chunk is that of the lines 21 to 40
  int chunk = 1;         ///< lines
  bool visible = false;  ///< only visible checks: the next run grades the hidden ones
  std::filesystem::path out{};
  std::filesystem::path secret{};
  bool evidence = false;
  bool accept = false;              ///< take a result with fewer points, too
  std::filesystem::path workers{};  ///< folder that keeps compiled programs; empty: none
};
/// Grades them one after another, each in a process of its own, unless they have valid results. kFull if all
/// have one afterwards.
[[nodiscard]] ExitCode gradeOne(const Project& project, const GradeOneOptions& options);

/// What `rex grade --collect` makes of a folder of results.
struct CollectOptions {
  std::filesystem::path out{};
  std::filesystem::path manifest{};  ///< empty: tasks.tsv in it
  ClassFiles files{};
  bool csv = false;
  bool json = false;
  std::string reports{};  ///< see parseReportFormats()
};
/// Makes grades.csv from all results and names the tasks to repeat. kGraderFault if there are any.
[[nodiscard]] ExitCode collectResults(const Project& project, const CollectOptions& options);

/// Writes missing reports next to the result of each task that has one, renews outdated ones in any format,
/// and removes those that no longer have a result.
void writeReports(const classroom::ClassRun& run, const std::vector<reports::ReportFormat>& reports,
                  const classroom::Gradebook& book);

/// Writes OUT/grades.csv, with the other tables of a grade book if there is one, and prints it on request.
/// Reports tasks without a valid result, and returns false if there are any.
[[nodiscard]] bool writeGrades(const classroom::ClassRun& run, const classroom::LatePolicy& policy,
                               const classroom::Gradebook* book, bool print);

/// Says which results with fewer points wait to be accepted; their number.
int tellHeldBack(const classroom::ClassRun& run);

/// The points of files before and after they are graded again, by another grader or with other random cases.
class Regrading {
 public:
  /// Notes the points of the tasks that will be graded again (`isOpen`, by index) or whose new result waits.
  /// They are kept in the folder of results until tell(), so that an interrupted regrading goes on with them.
  /// `accept` takes results that wait. Throws Error if the notes of an interrupted run cannot be read.
  Regrading(classroom::ClassRun& run, const std::function<bool(std::size_t)>& isOpen, bool accept);

  /// Says which points have changed. Writes regraded.csv if anything was graded again or accepted in this
  /// run; the table of an earlier one stays.
  void tell() const;

 private:
  void readNotes();
  void writeNotes() const;

  const classroom::ClassRun& run_;
  std::vector<std::optional<int>> before_{};  ///< of each task; empty: it was not graded before
  std::map<std::string, int> noted_{};        ///< of an interrupted run: by student, exercise and text
  bool isNew_ = false;                        ///< something is graded again, or accepted
};

}  // namespace rex::cli
