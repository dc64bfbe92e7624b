#include <algorithm>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/terminal.h"

namespace rex::cli {

ExitCode list(const Project& project) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  if (exercises.empty()) {
    say("There are no exercises yet. `rex dev new 99-demo` makes one.");
    return ExitCode::kFull;
  }
  std::size_t nameWidth = 8;
  for (const ExerciseInfo& exercise : exercises) nameWidth = std::max(nameWidth, exercise.name.size());
  say(paint(Colour::kBold, fmt::format("{:{}}  points  script  title", "exercise", nameWidth)));
  for (const ExerciseInfo& exercise : exercises) {
    const std::string start =
        fmt::format("{:{}}  {:6}  {:6}  ", exercise.name, nameWidth, exercise.points(), exercise.script);
    say(start + wrap(exercise.title, start.size(), start.size()));
  }
  say();
  say(wrap(fmt::format("Read {}, edit main.cpp there, then: rex test {}",
                       shown(exercises.front().folder / "README.md"), exercises.front().name),
           0, 0));
  return ExitCode::kFull;
}

}  // namespace rex::cli
