#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command_table.h"
#include "cli/json_internal.h"
#include "cli/option_table_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

void sayJson(const std::vector<ExerciseInfo>& exercises) {
  Json all = Json::array();
  for (const ExerciseInfo& exercise : exercises) {
    Json parts = Json::array();
    for (const submission::ExercisePart& part : exercise.parts)
      parts.push_back({{"id", part.id}, {"title", part.title}, {"points", part.points}});
    all.push_back({{"name", exercise.name},
                   {"title", exercise.title},
                   {"script", exercise.script},
                   {"folder", exercise.folder.string()},
                   {"points", exercise.points()},
                   {"parts", parts}});
  }
  say(dump(Json{{"exercises", all}}));
}

ExitCode list(const Project& project, bool json) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  if (json) {
    sayJson(exercises);
    return ExitCode::kFull;
  }
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
    say(paint(Colour::kBold, start) +
        wrap(exercise.title + (project.isBuilt(exercise.name) ? "" : " (not built in this rex)"), indent,
             indent));
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
  const auto json = std::make_shared<bool>(false);
  command->footer("Examples:\n  scripts/rex list\n  scripts/rex list --json");
  addOptions(command, {{"--json", *json, "print JSON"}});
  command->callback([&action, json] { action = [json](const Project& p) { return list(p, *json); }; });
}

}  // namespace rex::cli
