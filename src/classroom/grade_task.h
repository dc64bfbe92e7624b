#pragma once
// Grading one task of a class:
//   const classroom::StoredResult stored = classroom::readStored(task, "results", "");
//   if (!stored.isDone())
//     result = classroom::gradeTask(task, stored, toolchain, exercise, {.out = "results", .workFolder =
//     work});

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "classroom/stored_result.h"
#include "classroom/task_list.h"
#include "grading/grading_job.h"
#include "grading/results.h"
#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::classroom {

/// Hash of everything that grades an exercise here: its description and grader, the compiler and flags for
/// students' files, the headers they may include, the library they are linked to, the running program
/// itself, and the sandbox launcher if there is one. Throws Error if one of these files cannot be read.
[[nodiscard]] std::string graderFingerprint(const submission::Toolchain& toolchain,
                                            const submission::ExerciseInfo& exercise,
                                            const std::filesystem::path& launcher);

/// The result of the visible checks of a task, which a second pass can continue; empty: there is none.
[[nodiscard]] std::optional<grading::ResultFile> readFirstPass(const Task& task,
                                                               const std::filesystem::path& out,
                                                               std::string_view secret);

struct TaskOptions {
  std::filesystem::path out{};                 ///< folder of all results
  std::filesystem::path workFolder{};          ///< for this task alone, made if missing
  std::filesystem::path launcher{};            ///< of the sandbox
  std::filesystem::path secret{};              ///< file with the secret of the course; empty: none
  bool evidence = false;                       ///< keep pictures and replays of failed visible checks
  bool alone = false;                          ///< see grading::GradedWith
  std::filesystem::path workers{};             ///< where compiled programs are kept; empty: they are not
  bool accept = false;                         ///< take a result with fewer points for the same text, too
  bool recompile = false;                      ///< build even what is kept there
  grading::Pass pass = grading::Pass::kWhole;  ///< of a class; both share the work folder
};

/// Grades a task that has the result `stored`, and writes OUT/STUDENT/EXERCISE/results.json, the hash
/// of the inputs, build.log and, on request or if that result had it, the folder checks; each file is written
/// completely or not at all. Reports of that result are removed. If the same text had more points before,
/// that result stays, and the new one waits in the folder `regraded` (StoredResult::waiting). A first pass
/// leaves its result in the folder `visible` if there are hidden checks to run. Throws Error without writing
/// a result if the file or the grader is not that of the task.
[[nodiscard]] grading::GradeResult gradeTask(const Task& task, const StoredResult& stored,
                                             const submission::Toolchain& toolchain,
                                             const submission::ExerciseInfo& exercise,
                                             const TaskOptions& options);

/// The text of a file to grade, or "" if it cannot be read: see Task::sourceSha256.
[[nodiscard]] std::string gradedText(const std::filesystem::path& file);

}  // namespace rex::classroom
