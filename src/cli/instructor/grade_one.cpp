#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/private_folder.h"
#include "classroom/grade_task.h"
#include "cli/instructor/grading_options_internal.h"
#include "cli/instructor/instructor_room_internal.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

struct GradeOneOptions {
  std::filesystem::path manifest{};
  int task = 0;  ///< from 1
  std::filesystem::path out{};
  std::filesystem::path secret{};
  bool evidence = false;
  bool accept = false;              ///< take a result with fewer points, too
  std::filesystem::path workers{};  ///< folder that keeps compiled programs; empty: none
};

// Grades one line of a list of tasks, unless it has a valid result. kFull if it has one afterwards.
ExitCode gradeOne(const Project& project, const GradeOneOptions& options) {
  const std::vector<grading::Task> tasks = grading::readManifest(options.manifest);
  if (options.task < 1 || options.task > static_cast<int>(tasks.size()))
    throw UsageError({.what = "--task",
                      .found = fmt::format("{}", options.task),
                      .wanted = fmt::format("1 to {}", tasks.size())});
  const grading::Task& task = tasks[static_cast<std::size_t>(options.task) - 1];
  const std::string name = fmt::format("{} {}", task.student, task.exercise);
  if (grading::stateOf(task, options.out) == grading::TaskState::kDone &&
      (!options.evidence || grading::hasEvidence(task, options.out))) {
    say(fmt::format("{}: kept", name));
    return ExitCode::kFull;
  }
  const auto sandbox = chooseSandbox(project, task.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const ExerciseInfo exercise = project.exercise(task.exercise);
  const PrivateFolder work(std::filesystem::temp_directory_path());
  const grading::GradeResult result = grading::gradeTask(task, prepare(project, exercise), exercise,
                                                         {.out = options.out,
                                                          .workFolder = work.path(),
                                                          .launcher = sandbox->launcher,
                                                          .secret = options.secret,
                                                          .evidence = options.evidence,
                                                          .workers = options.workers,
                                                          .accept = options.accept});
  say(wrap(harmless(fmt::format("{}: {}, {} of {} points {}", name, toString(result.outcome), result.score,
                                result.maxScore, result.message)),
           2, 0));
  return result.outcome == grading::Outcome::kGraderError ? ExitCode::kGraderFault : ExitCode::kFull;
}

}  // namespace

void addGradeOne(CLI::App* command, Action& action) {
  const auto options = std::make_shared<GradeOneOptions>();
  command->footer("Example: scripts/rex grade-one --manifest tasks.tsv --task 7 --out results\n\n" +
                  std::string(kGradingCodes));
  command->add_option("--manifest", options->manifest, "list of tasks that `rex grade --manifest` wrote")
      ->type_name("FILE.tsv")
      ->required();
  command->add_option("--task", options->task, "number of the task, from 1")->type_name("K")->required();
  addResults(command, options->out);
  addSecret(command, options->secret);
  addEvidence(command, options->evidence);
  addWorkers(command, options->workers);
  addAccept(command, options->accept);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return gradeOne(p, *options); }; });
}

}  // namespace rex::cli
