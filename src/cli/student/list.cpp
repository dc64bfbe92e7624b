#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/student/student_room_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

ExitCode list(const Project& project) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  if (exercises.empty()) {
    say(project.installed.empty() ? "There are no exercises yet. `scripts/rex dev new 99-demo` makes one."
                                  : kNoCourseHere);
    return ExitCode::kFull;
  }
  std::size_t nameWidth = 0;
  for (const ExerciseInfo& exercise : exercises) nameWidth = std::max(nameWidth, exercise.name.size());
  for (const ExerciseInfo& exercise : exercises) {
    const std::string start =
        fmt::format("{:{}}  {:2} points  ", exercise.name, nameWidth, exercise.points());
    const std::size_t indent = start.size();
    say(paint(Colour::kBold, start) + wrap(exercise.title, indent, indent));
    say(std::string(indent, ' ') + wrap("script: " + exercise.script, indent, indent));
  }
  say();
  say(wrap(fmt::format("Read {}, edit main.cpp there, then: scripts/rex test {}",
                       shown(exercises.front().folder / "README.md"), exercises.front().name),
           0, 0));
  return ExitCode::kFull;
}

}  // namespace

void addList(CLI::App* command, Action& action) {
  command->footer("Example: scripts/rex list");
  command->callback([&action] { action = list; });
}

}  // namespace rex::cli
