#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/process_pool.h"
#include "classroom/grade_task.h"
#include "cli/instructor/collect.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

using classroom::Task;

/// What the tasks of a chunk have in common, made when the first one asks.
struct ChunkTools {
  std::map<sandbox::Level, std::optional<sandbox::Sandbox>> sandboxes{};
  std::map<std::string, submission::Toolchain> toolchains{};
};

std::string nameOf(const Task& task) { return fmt::format("{} {}", task.student, task.exercise); }

ExitCode gradeTaskOf(const Project& project, const Task& task, const sandbox::Sandbox& sandbox,
                     const submission::Toolchain& toolchain, const GradeOneOptions& options) {
  const PrivateFolder work(std::filesystem::temp_directory_path());
  const ExerciseInfo exercise = project.exercise(task.exercise);
  const std::string secret = classroom::classSecret(options.secret);
  const classroom::StoredResult stored = classroom::readStored(task, options.out, secret);
  const grading::Pass pass = options.visible                                       ? grading::Pass::kVisible
                             : classroom::readFirstPass(task, options.out, secret) ? grading::Pass::kHidden
                                                                                   : grading::Pass::kWhole;
  const grading::GradeResult result = classroom::gradeTask(task, stored, toolchain, exercise,
                                                           {.out = options.out,
                                                            .workFolder = work.path(),
                                                            .launcher = sandbox.launcher,
                                                            .secret = options.secret,
                                                            .evidence = options.evidence,
                                                            .workers = options.workers,
                                                            .accept = options.accept,
                                                            .pass = pass});
  if (awaitsHiddenChecks(result) && options.visible) {
    say(fmt::format("{}: visible checks graded", escapeForTerminal(nameOf(task))));
    std::fflush(stdout);
    return ExitCode::kFull;
  }
  say(wrap(escapeForTerminal(fmt::format("{}: {}, {} of {} points {}", nameOf(task), toString(result.outcome),
                                         result.score, result.maxScore, result.message)),
           2, 0));
  std::fflush(stdout);  // this process ends without
  return result.outcome == grading::Outcome::kGraderError ? ExitCode::kGraderFault : ExitCode::kFull;
}

// In a process of its own, so that the next task of the chunk is graded whatever becomes of this one.
ExitCode gradeTaskApart(const Project& project, const Task& task, ChunkTools& tools,
                        const GradeOneOptions& options) {
  const classroom::StoredResult stored =
      classroom::readStored(task, options.out, classroom::classSecret(options.secret));
  if (stored.isDone() && (!options.evidence || stored.hasEvidence)) {
    say(fmt::format("{}: kept", nameOf(task)));
    return ExitCode::kFull;
  }
  if (!tools.sandboxes.contains(task.level)) tools.sandboxes[task.level] = chooseSandbox(project, task.level);
  const std::optional<sandbox::Sandbox>& sandbox = tools.sandboxes[task.level];
  if (!sandbox) return ExitCode::kWeakSandbox;
  if (!tools.toolchains.contains(task.exercise))
    tools.toolchains[task.exercise] = prepare(project, project.exercise(task.exercise));
  ExitCode code = ExitCode::kGraderFault;
  const auto grade = [&](int) {
    try {
      return static_cast<int>(
          gradeTaskOf(project, task, *sandbox, tools.toolchains.at(task.exercise), options));
    } catch (const std::exception& error) {
      note(wrap(escapeForTerminal(fmt::format("{}: {}", nameOf(task), error.what())), 2, 0));
      return static_cast<int>(ExitCode::kGraderFault);
    }
  };
  forkMap(
      1, 1, grade,
      [&](int, int ended) {
        if (ended < 0)
          note(fmt::format("{}: the grading was ended by signal {}: grade it again",
                           escapeForTerminal(nameOf(task)), -ended));
        if (ended == static_cast<int>(ExitCode::kFull)) code = ExitCode::kFull;
      },
      kSecondsOfTask);
  return code;
}

}  // namespace

ExitCode gradeOne(const Project& project, const GradeOneOptions& options) {
  const std::vector<Task> tasks = classroom::readManifest(options.manifest);
  const int count = static_cast<int>(tasks.size()), chunks = (count + options.chunk - 1) / options.chunk;
  if (options.task < 1 || options.task > chunks)
    throw UsageError({.what = "--task",
                      .found = fmt::format("{}", options.task),
                      .wanted = options.chunk == 1
                                    ? fmt::format("1 to {}", chunks)
                                    : fmt::format("1 to {}, in chunks of {}", chunks, options.chunk)});
  ChunkTools tools;
  ExitCode worst = ExitCode::kFull;
  const int first = (options.task - 1) * options.chunk, end = std::min(first + options.chunk, count);
  for (int k = first; k < end; ++k) {
    const ExitCode code = gradeTaskApart(project, tasks[static_cast<std::size_t>(k)], tools, options);
    if (code == ExitCode::kWeakSandbox) return code;
    if (code != ExitCode::kFull) worst = code;
  }
  return worst;
}

}  // namespace rex::cli
