#pragma once
// What a folder of results holds for each task. Every file is read once, so that all tables and reports of a
// run say the same, even if a file changes meanwhile:
//   classroom::ClassRun run = classroom::readClassRun(tasks, "results");
//   for (const classroom::StoredResult& one : run.stored) done += one.state == classroom::TaskState::kDone;
//   const classroom::Gradebook book = classroom::makeGradebook(run, source);

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "classroom/task_list.h"
#include "grading/results.h"

namespace rex::classroom {

inline constexpr const char *kResults = "results.json", *kBuildLog = "build.log",
                            *kEvidence = "checks",          ///< folder of pictures and replays
                                *kRegraded = "regraded",    ///< folder of a result that waits to be accepted
                                    *kVisible = "visible";  ///< folder of a result without hidden checks

/// The state of a task's result. A stale result is one for other inputs; a failed one reports a grader
/// error, which is never a grade; a refused one was changed after the grading.
enum class TaskState { kMissing, kStale, kFailed, kRefused, kDone };

/// What the result files of a task say, judged for that task.
struct StoredResult {
  TaskState state = TaskState::kMissing;  ///< by the file alone: tables do not ask for the secret
  std::string why{};                      ///< why it is not believed, with the secret; empty: it is
  std::optional<grading::GradeResult>
      result{};                  ///< what counts; empty: there is none, or no result in its file
  std::optional<int> before{};   ///< points of a valid result for the same text, whatever graded it
  std::optional<int> waiting{};  ///< points of one with fewer for these inputs, while that counts
  std::optional<grading::GradedWith>
      with{};                ///< of what waits, or else of what counts; empty: it does not say
  bool evidence = false;     ///< pictures and replays were kept
  bool hasEvidence = false;  ///< and still exist

  /// Whether it is valid, for those who have the secret, too.
  [[nodiscard]] bool isDone() const { return state == TaskState::kDone && why.empty(); }
  /// The points of what waits, or else of what counts.
  [[nodiscard]] std::optional<int> now() const;
};

/// The result files of a task, read once.
struct StoredFiles {
  std::optional<grading::ResultFile> counts{}, waits{};
  [[nodiscard]] std::optional<grading::GradedWith> with() const;
};

/// The tasks of a class, and what is stored for each.
struct ClassRun {
  std::filesystem::path out{};  ///< folder of all results
  std::string secret{};         ///< the text of the secret of the course; empty: none
  std::vector<Task> tasks{};
  std::vector<StoredResult> stored{};  ///< of each task

  void add(Task task, StoredFiles files);
  /// After that task was graded.
  void readAgain(std::size_t task);
};

/// Throws Error if a file, or that of the secret, cannot be read.
[[nodiscard]] ClassRun readClassRun(const std::vector<Task>& tasks, const std::filesystem::path& out,
                                    const std::filesystem::path& secret = {});

/// The text of the secret of the course in that file; empty without a file. Throws like readCourseSecret().
[[nodiscard]] std::string classSecret(const std::filesystem::path& file);

/// OUT/STUDENT/EXERCISE.
[[nodiscard]] std::filesystem::path resultFolder(const std::filesystem::path& out, const Task& task);

[[nodiscard]] StoredFiles readStoredFiles(const std::filesystem::path& folder);

/// For one task, with the text of the secret of the course; empty: none.
[[nodiscard]] StoredResult readStored(const Task& task, const std::filesystem::path& out,
                                      std::string_view secret);

/// Why a result for the inputs of the task is not believed: its fault, another exercise, or that the secret
/// of the course, if it is given, did not make its HMAC; empty if it is believed.
[[nodiscard]] std::string whyRefused(const grading::ResultFile& read, const std::filesystem::path& file,
                                     const Task& task, std::string_view secret);

/// The HMAC of a result with these inputs. Anyone who can write to the folder of results can make a seal;
/// this needs the secret.
[[nodiscard]] std::string resultHmac(const grading::ResultInputs& inputs, const Task& task,
                                     std::string_view secret);

/// Removes the reports in a folder of results, all formats.
void removeReports(const std::filesystem::path& folder);

/// Puts results that wait in the place of those that count; goes on after an interruption.
void acceptRegradings(ClassRun& run);

}  // namespace rex::classroom
