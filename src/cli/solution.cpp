#include <fmt/format.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/progress_file.h"
#include "cli/student_file.h"
#include "cli/terminal.h"
#include "grading/text_file.h"

namespace rex::cli {

using grading::SolutionRule;

ExitCode solution(const Project& project, const std::string& name) {
  const ExerciseInfo exercise = project.exercise(name);
  if (exercise.solution == SolutionRule::never)
    throw UsageError({.what = fmt::format("the course does not show the solution of {}", exercise.name)});
  const std::filesystem::path file = chooseStudentFile(exercise, true);
  const AllProgress all = ProgressFile(project.root).read();
  const auto found = all.exercises.find(exercise.name);
  const bool isSolved = found != all.exercises.end() && found->second.solved;
  if (exercise.solution == SolutionRule::afterPass && !isSolved) {
    note(wrap(
        fmt::format("The solution of {} is shown once `scripts/rex test {}` gave you the full score. Until "
                    "then: scripts/rex hint {}",
                    exercise.name, exercise.name, exercise.name),
        0, 0));
    return ExitCode::kBelow;
  }
  std::fputs(grading::readTextFile(file).c_str(), stdout);
  return ExitCode::kFull;
}

}  // namespace rex::cli
