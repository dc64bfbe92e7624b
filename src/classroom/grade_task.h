#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "classroom/late_policy.h"
#include "classroom/task_list.h"
#include "grading/results.h"
#include "submission/build_tools.h"
#include "submission/exercise_info.h"
#include "submission/submission.h"

namespace rex::classroom {

/// The compiler's output for a submission, next to its result.
inline constexpr const char* kBuildLog = "build.log";

/// Where programs are kept. The key must depend on everything that a build depends on. Only the grader's
/// user may write to the folder, because programs in it are run. Several gradings may share it.
struct KeptWorkers {
  std::filesystem::path folder{};
  std::string key{};
  bool recompile = false;  ///< build even if it is kept
};

/// The result of buildSubmission(), taken from the folder if an earlier call with the same key left it
/// there, else built and stored. Files that do not compile are built each time, and so are programs with a
/// wrong hash. Throws Error if the folder cannot be written.
[[nodiscard]] submission::BuiltSubmission buildOnce(const KeptWorkers& keeping,
                                                    const submission::Toolchain& toolchain,
                                                    const submission::ExerciseInfo& exercise,
                                                    const submission::SubmissionOptions& options);

/// The results found for a list of tasks, which are numbered from 1.
struct Collected {
  std::string csv{};           ///< one line per task, in their order
  std::vector<int> missing{};  ///< without a result
  std::vector<int> stale{};    ///< with a result for other inputs
  std::vector<int> refused{};  ///< with a result that was changed after the grading
  std::vector<int> failed{};   ///< the grader failed: to be repeated, never zero points
};

/// Reads all results below `out`. A task without a valid result has no points in its line.
[[nodiscard]] Collected collect(const std::vector<Task>& tasks, const std::filesystem::path& out,
                                const LatePolicy& policy);

/// "1,4-6,9": how batch systems name tasks.
[[nodiscard]] std::string numberRanges(std::vector<int> numbers);

/// Hash of everything that grades an exercise here: its description and grader, the compiler and flags for
/// students' files, the headers they may include, the library they are linked to, the running program
/// itself, and the sandbox launcher if there is one. Throws Error if one of these files cannot be read.
[[nodiscard]] std::string graderFingerprint(const submission::Toolchain& toolchain,
                                            const submission::ExerciseInfo& exercise,
                                            const std::filesystem::path& launcher);

/// The first digits of the hash of the secret in that file, which identify it in results.
[[nodiscard]] std::string secretFileId(const std::filesystem::path& secret);

/// OUT/STUDENT/EXERCISE.
[[nodiscard]] std::filesystem::path resultFolder(const std::filesystem::path& out, const Task& task);

/// The state of a task's result. A stale result is one for other inputs; a failed one reports a grader
/// error, which is never a grade; a refused one was changed after the grading.
enum class TaskState { kMissing, kStale, kFailed, kRefused, kDone };
[[nodiscard]] TaskState taskState(const Task& task, const std::filesystem::path& out,
                                  const std::filesystem::path& secret = {});

/// Why a result for the inputs of the task is not believed: the message of loadSoundResult(), or that the
/// secret of the course, if it is given, did not make its HMAC; empty if it is believed.
[[nodiscard]] std::string whyRefused(const Task& task, const std::filesystem::path& out,
                                     const std::filesystem::path& secret = {});

/// Removes the reports in a folder of results, all formats.
void removeReports(const std::filesystem::path& folder);

/// Whether a result with fewer points for these inputs waits to be accepted, while the old one counts.
[[nodiscard]] bool isHeldBack(const Task& task, const std::filesystem::path& out);
/// Puts that result in the place of the old one, if there is one; goes on after an interruption.
void acceptRegrading(const Task& task, const std::filesystem::path& out);
/// The points of a result for the same text, whatever graded it; empty: there is none.
[[nodiscard]] std::optional<int> pointsBefore(const Task& task, const std::filesystem::path& out);
/// The points of the result that waits, or else of the one that counts, if there is a valid one.
[[nodiscard]] std::optional<int> pointsNow(const Task& task, const std::filesystem::path& out);

/// What a result was made with, besides the text and the grader.
struct GradedWith {
  sandbox::Level level{};
  std::optional<std::uint64_t> seed{};
  std::string secretId{};
  bool alone = false;  ///< by `rex grade --student`: the settings of the class do not count
};
/// That of the result of a task, or of the one that waits; empty: there is none, or it does not say.
[[nodiscard]] std::optional<GradedWith> gradedWith(const Task& task, const std::filesystem::path& out);

/// Whether the pictures and replays of a finished task were kept and still exist.
[[nodiscard]] bool hasEvidence(const Task& task, const std::filesystem::path& out);

/// Whether the visible checks of a task were graded: a first pass has left what a second can continue.
[[nodiscard]] bool awaitsSecondPass(const Task& task, const std::filesystem::path& out,
                                    const std::filesystem::path& secret);

struct TaskOptions {
  std::filesystem::path out{};                 ///< folder of all results
  std::filesystem::path workFolder{};          ///< for this task alone, made if missing
  std::filesystem::path launcher{};            ///< of the sandbox
  std::filesystem::path secret{};              ///< file with the secret of the course; empty: none
  bool evidence = false;                       ///< keep pictures and replays of failed visible checks
  bool alone = false;                          ///< see GradedWith
  std::filesystem::path workers{};             ///< where compiled programs are kept; empty: they are not
  bool accept = false;                         ///< take a result with fewer points for the same text, too
  bool recompile = false;                      ///< build even what is kept there
  grading::Pass pass = grading::Pass::kWhole;  ///< of a class; both share the work folder
};

/// Grades a task and writes OUT/STUDENT/EXERCISE/results.json, the hash of the inputs, build.log and, on
/// request or if the result before had it, the folder checks; each file is written completely or not at all.
/// Reports of an earlier result are removed. If the same text had more points before, that result stays, and
/// the new one waits in the folder `regraded` (isHeldBack()). A first pass leaves its result in the folder
/// `visible` if there are hidden checks to run. Throws Error without writing a result if the file or the
/// grader is not that of the task.
[[nodiscard]] grading::GradeResult gradeTask(const Task& task, const submission::Toolchain& toolchain,
                                             const submission::ExerciseInfo& exercise,
                                             const TaskOptions& options);

/// The text of a file to grade, or "" if it cannot be read: see Task::sourceSha256.
[[nodiscard]] std::string gradedText(const std::filesystem::path& file);

}  // namespace rex::classroom
