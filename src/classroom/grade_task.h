#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/task_list.h"
#include "grading/results.h"
#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// The first digits of the hash of the secret in that file, by which results name it.
[[nodiscard]] std::string secretIdOf(const std::filesystem::path& secret);

/// OUT/STUDENT/EXERCISE.
[[nodiscard]] std::filesystem::path resultFolder(const std::filesystem::path& out, const Task& task);

/// What lies there of a task. A stale result is one of other inputs; a failed one reports a fault of the
/// grader, which is never a grade.
enum class TaskState { kMissing, kStale, kFailed, kDone };
[[nodiscard]] TaskState stateOf(const Task& task, const std::filesystem::path& out);

/// Whether the pictures and replays of a task that is done were kept, and are still there.
[[nodiscard]] bool hasEvidence(const Task& task, const std::filesystem::path& out);

struct TaskOptions {
  std::filesystem::path out{};         ///< of all results
  std::filesystem::path workFolder{};  ///< of this task alone, made if missing
  std::filesystem::path launcher{};    ///< of the sandbox
  std::filesystem::path secret{};      ///< file with the secret of the course; empty: none
  bool evidence = false;               ///< keep pictures and replays of visible checks that do not hold
  std::filesystem::path workers{};     ///< where compiled programs are kept; empty: nowhere
  bool anew = false;                   ///< compile also what is kept there
};

/// Grades and writes OUT/STUDENT/EXERCISE/results.json, with the hash of the inputs, build.log and, if asked,
/// the folder checks: each file whole or not at all. Throws Error, writing no result, if the file or the
/// grader are not those of the task.
[[nodiscard]] GradeResult gradeTask(const Task& task, const Toolchain& toolchain,
                                    const ExerciseInfo& exercise, const TaskOptions& options);

/// The text of a file to grade, or "" where it cannot be read: see Task::sourceSha256.
[[nodiscard]] std::string gradedText(const std::filesystem::path& file);

}  // namespace rex::grading
