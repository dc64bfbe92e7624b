#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/terminal.h"
#include "submission/regions.h"

namespace rex::cli {

ExitCode devStrip(const Project& project, const std::string& name) {
  requireSourceTree(project, "strip");
  const ExerciseInfo exercise = project.exercise(name);
  const std::filesystem::path solution = exercise.folder / "solution.cpp",
                              main = exercise.folder / "main.cpp";
  if (!std::filesystem::exists(solution))
    throw UsageError({.what = "there is no solution to strip", .where = {solution.string()}});
  writeTextFile(main, submission::stripSolution(readTextFile(solution), solution.string()));
  say(fmt::format("Wrote {}.", main.string()));
  return ExitCode::kFull;
}

}  // namespace rex::cli
