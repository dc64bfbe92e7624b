#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/student/exercise_commands.h"
#include "cli/student/progress.h"
#include "cli/terminal.h"
#include "grading/results.h"

namespace rex::cli {
namespace {

using submission::ExercisePart;

// Of the last complete test; empty: there was none.
std::vector<grading::CheckResult> lastChecks(const Project& project, const ExerciseInfo& exercise) {
  try {
    return grading::loadResult(project.outFolder(exercise, false) / "results.json").checks;
  } catch (const Error&) {
    return {};
  }
}

// By its name, or that of a check or of a function which `rex test` printed.
const ExercisePart& partCalled(const ExerciseInfo& exercise, const std::vector<grading::CheckResult>& last,
                               const std::string& id) {
  std::vector<std::string> ids;
  for (const ExercisePart& part : exercise.parts) {
    if (part.id == id) return part;
    ids.push_back(part.id);
  }
  for (const grading::CheckResult& check : last)
    for (const ExercisePart& part : exercise.parts)
      if (part.id == check.part && (check.id == id || check.function == id)) return part;
  throw UsageError({.what = fmt::format("{} has no part '{}'", exercise.name, escapeForTerminal(id)),
                    .wanted = fmt::format("one of {}", join(ids, ", ")),
                    .nearest = nearestNames(id, ids)});
}

// The first part that lost points in the last test, nullptr if none did; the first part if there was no test.
const ExercisePart* partInNeed(const ExerciseInfo& exercise, const std::vector<grading::CheckResult>& last) {
  for (const ExercisePart& part : exercise.parts)
    for (const grading::CheckResult& check : last)
      if (check.part == part.id && check.points < check.maxPoints) return &part;
  return last.empty() ? &exercise.parts.front() : nullptr;
}

void sayHint(const ExercisePart& part, int number) {
  const std::string start = fmt::format("  {} of {}: ", number, part.hints.size());
  say(start + wrap(part.hints[static_cast<std::size_t>(number - 1)], start.size(), start.size()));
}

}  // namespace

ShownHints openHint(const Project& project, const ExerciseInfo& exercise, const ExercisePart& part,
                    bool again) {
  const int all = static_cast<int>(part.hints.size());
  ShownHints hints;
  hints.isKept = ProgressFile(project.root).change(exercise.name, [&](Progress& progress) {
    int& shownSoFar = progress.hints[part.id];
    hints.before = std::clamp(shownSoFar, 0, all);
    hints.now = again ? hints.before : std::min(hints.before + 1, all);
    shownSoFar = hints.now;
  });
  if (!again) hints.now = std::max(hints.now, 1);  // also if progress cannot be stored
  return hints;
}

ExitCode hint(const Project& project, const HintOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const std::vector<grading::CheckResult> last = lastChecks(project, exercise);
  const ExercisePart* needed =
      options.part.empty() ? partInNeed(exercise, last) : &partCalled(exercise, last, options.part);
  if (needed == nullptr) {
    say(fmt::format("Every part of {} got full points in your last test. Name a part for its hints.",
                    exercise.name));
    return ExitCode::kFull;
  }
  const ExercisePart& part = *needed;
  const int all = static_cast<int>(part.hints.size());
  if (all == 0) {
    say(fmt::format("There are no hints for part '{}' of {}.", part.id, exercise.name));
    return ExitCode::kFull;
  }
  const auto [before, now, kept] = openHint(project, exercise, part, options.again);
  say(paint(Colour::kBold, fmt::format("{} [{}]", part.title, part.id)));
  if (options.again && now == 0) say("  no hint was shown yet");
  // Hints that were shown before are repeated only on request or if there is no new one.
  for (int number = now > before ? now : 1; number <= now; ++number) sayHint(part, number);
  if (now == all)
    say("  That was the last hint for this part.");
  else if (!kept)
    say(fmt::format("  {} more in {} (progress cannot be stored here)", all - now,
                    shown(exercise.folder / "exercise.toml")));
  else
    say(fmt::format("  {} more: scripts/rex hint {} {}", all - now, exercise.name, part.id));
  return ExitCode::kFull;
}

void addHint(CLI::App* command, Action& action) {
  const auto options = std::make_shared<HintOptions>();
  command->footer(
      "Examples:\n  scripts/rex hint 01\n  scripts/rex hint 01 step --again\n\n"
      "Without PART: a hint for the first part that lost points in your last test. A check or a\n"
      "function that the test named stands for its part.");
  addExercise(command, options->exercise);
  command->add_option("PART", options->part, "id of a part in exercise.toml")->type_name("");
  addOptions(command, {{"--again", options->again, "show the hints that you have already seen"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return hint(p, *options); }; });
}

}  // namespace rex::cli
