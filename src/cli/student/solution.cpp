#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/student/exercise_option_internal.h"
#include "cli/student/progress_file.h"
#include "cli/student/student_file.h"
#include "cli/student/student_room_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

using grading::SolutionRule;

// Prints the reference solution if the course allows it. kBelow if the exercise must be solved first.
ExitCode solution(const Project& project, const std::string& name) {
  const ExerciseInfo exercise = project.exercise(name);
  if (exercise.solution == SolutionRule::kNever)
    throw UsageError({.what = fmt::format("the course does not show the solution of {}", exercise.name)});
  const std::filesystem::path file = chooseStudentFile(exercise, true);
  const AllProgress all = ProgressFile(project.root).read();
  const auto found = all.exercises.find(exercise.name);
  const bool isSolved = found != all.exercises.end() && found->second.solved;
  if (exercise.solution == SolutionRule::kAfterPass && !isSolved) {
    note(wrap(
        fmt::format("The solution of {} is shown once `scripts/rex test {}` has given you the full score. "
                    "Until then: scripts/rex hint {}",
                    exercise.name, exercise.name, exercise.name),
        0, 0));
    return ExitCode::kBelow;
  }
  std::fputs(readTextFile(file).c_str(), stdout);
  return ExitCode::kFull;
}

}  // namespace

void addSolution(CLI::App* command, Action& action) {
  const auto name = std::make_shared<std::string>();
  command->footer("Example: scripts/rex solution 01");
  addExercise(command, *name);
  command->callback([&action, name] { action = [name](const Project& p) { return solution(p, *name); }; });
}

}  // namespace rex::cli
