#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "base/child.h"
#include "base/error.h"
#include "base/folders.h"
#include "classroom/grade_task.h"
#include "cli/instructor/collect.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"

namespace rex::cli {
ExitCode gradeOne(const Project& project, const GradeOneOptions& options) {
  const std::vector<classroom::Task> tasks = classroom::readManifest(options.manifest);
  if (options.task < 1 || options.task > static_cast<int>(tasks.size()))
    throw UsageError({.what = "--task",
                      .found = fmt::format("{}", options.task),
                      .wanted = fmt::format("1 to {}", tasks.size())});
  const classroom::Task& task = tasks[static_cast<std::size_t>(options.task) - 1];
  const std::string name = fmt::format("{} {}", task.student, task.exercise);
  const classroom::StoredResult stored =
      classroom::readStored(task, options.out, classroom::classSecret(options.secret));
  if (stored.isDone() && (!options.evidence || stored.hasEvidence)) {
    say(fmt::format("{}: kept", name));
    return ExitCode::kFull;
  }
  const auto sandbox = chooseSandbox(project, task.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  lowerCpuSeconds(kSecondsOfTask);
  const ExerciseInfo exercise = project.exercise(task.exercise);
  const PrivateFolder work(std::filesystem::temp_directory_path());
  const grading::GradeResult result = classroom::gradeTask(task, stored, prepare(project, exercise), exercise,
                                                           {.out = options.out,
                                                            .workFolder = work.path(),
                                                            .launcher = sandbox->launcher,
                                                            .secret = options.secret,
                                                            .evidence = options.evidence,
                                                            .workers = options.workers,
                                                            .accept = options.accept});
  say(wrap(escapeForTerminal(fmt::format("{}: {}, {} of {} points {}", name, toString(result.outcome),
                                         result.score, result.maxScore, result.message)),
           2, 0));
  return result.outcome == grading::Outcome::kGraderError ? ExitCode::kGraderFault : ExitCode::kFull;
}

}  // namespace rex::cli
