#include <algorithm>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
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
      parts.push_back(
          {{"id", part.id}, {"title", part.title}, {"points", part.points}, {"core", part.isCore}});
    all.push_back({{"name", exercise.name},
                   {"title", exercise.title},
                   {"script", exercise.script},
                   {"chapter", exercise.chapter},
                   {"needs", exercise.needs},
                   {"hours", exercise.hours},
                   {"folder", exercise.folder.string()},
                   {"points", exercise.points()},
                   {"parts", parts}});
  }
  say(dump(Json{{"exercises", all}}));
}

std::string background(const ExerciseInfo& exercise) {
  std::string text = "script: " + exercise.script;
  if (!exercise.needs.empty()) text += "; builds on " + join(exercise.needs, ", ");
  if (exercise.hours > 0)
    text += fmt::format("; about {} hour{}", exercise.hours, exercise.hours == 1 ? "" : "s");
  return text;
}

ExitCode list(const Project& project, bool json) {
  std::vector<ExerciseInfo> exercises = project.exercises();
  std::stable_sort(exercises.begin(), exercises.end(),
                   [](const ExerciseInfo& a, const ExerciseInfo& b) { return a.chapter < b.chapter; });
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
  int chapter = 0;
  for (const ExerciseInfo& exercise : exercises) {
    if (exercise.chapter != std::exchange(chapter, exercise.chapter)) say(fmt::format("Chapter {}", chapter));
    const std::string start =
        fmt::format("{:{}}  {:2} points  ", exercise.name, nameWidth, exercise.points());
    const std::size_t indent = start.size();
    say(paint(Colour::kBold, start) +
        wrap(exercise.title + (project.isBuilt(exercise.name) ? "" : " (not built in this rex)"), indent,
             indent));
    say(std::string(indent, ' ') + wrap(background(exercise), indent, indent));
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
