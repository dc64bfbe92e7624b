#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/student/exercise_commands.h"
#include "cli/terminal.h"
#include "submission/regions.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// main.cpp as handed out: a release keeps a copy, the course makes it from the solution, and that of an
// installed rex is the copy of a course folder.
std::string starterOf(const ExerciseInfo& info) {
  const fs::path& exercise = info.definition;
  if (info.folder != exercise && !fs::exists(exercise / "starter.cpp"))
    return readTextFile(exercise / "main.cpp");
  const fs::path copy = exercise / "starter.cpp", solution = exercise / "solution.cpp";
  if (fs::exists(copy)) return readTextFile(copy);
  if (fs::exists(solution)) return submission::stripSolution(readTextFile(solution), solution.string());
  throw UsageError(
      {.what = fmt::format("{} has no copy of main.cpp as it was handed out", exercise.filename().string()),
       .where = {copy.string()}});
}

// Keeps the file under an unused name. A hard link cannot be lost half way; if the file system has no hard
// links, a copy is written to disk first.
fs::path keepBackup(const fs::path& main) {
  for (int k = 1;; ++k) {
    const fs::path backup = main.parent_path() / fmt::format("main.backup-{}.cpp", k);
    if (fs::exists(fs::symlink_status(backup))) continue;
    std::error_code refused;
    fs::create_hard_link(main, backup, refused);
    if (refused == std::errc::file_exists) continue;
    if (refused) replaceTextFile(backup, readTextFile(main), "the backup of your file");
    return backup;
  }
}

// Removes the backup if replacing fails: a hard link to main.cpp would change with it.
void replaceAndKeep(const fs::path& main, const std::string& starter) {
  const fs::path backup = keepBackup(main);
  try {
    replaceTextFile(main, starter, "the student's file");
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(backup, ignored);
    throw;
  }
  say(fmt::format("Your file was kept as {}.", shown(backup)));
}

}  // namespace

ExitCode reset(const Project& project, const std::string& name) {
  const ExerciseInfo exercise = project.exercise(name);
  const fs::path main = exercise.folder / "main.cpp";
  const std::string starter = starterOf(exercise);
  if (fs::exists(main)) {
    if (readTextFile(main) == starter) {
      say(fmt::format("{} is as it was handed out.", shown(main)));
      return ExitCode::kFull;
    }
    replaceAndKeep(main, starter);
  } else {
    replaceTextFile(main, starter, "the student's file");
  }
  say(fmt::format("{} is as it was handed out again.", shown(main)));
  return ExitCode::kFull;
}

void addReset(CLI::App* command, Action& action) {
  const auto name = std::make_shared<std::string>();
  command->footer("Example: scripts/rex reset 01\n\nYour file is kept next to it as main.backup-1.cpp.");
  addExercise(command, *name);
  command->callback([&action, name] { action = [name](const Project& p) { return reset(p, *name); }; });
}

}  // namespace rex::cli
