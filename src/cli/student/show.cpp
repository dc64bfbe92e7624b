#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/exercise_commands.h"
#include "cli/student/progress.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

namespace {

using submission::SolutionRule;

// RFC 3986: all characters but letters, digits and a few signs are written as % and two digits.
std::string urlOf(const fs::path& file) {
  constexpr std::string_view kPlain = "-._~/";
  std::string url = "file://";
  for (const char c : fs::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool isPlain = (byte < 0x80 && std::isalnum(byte) != 0) || kPlain.find(c) != kPlain.npos;
    url += isPlain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

// Prints the reference solution if the course allows it. kBelow if the exercise must be solved first.
ExitCode showSolution(const Project& project, const ExerciseInfo& exercise) {
  if (exercise.solution == SolutionRule::kNever)
    throw UsageError({.what = fmt::format("the course does not show the solution of {}", exercise.name)});
  const fs::path file = chooseStudentFile(exercise, true);
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

ExitCode show(const Project& project, const ShowOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  if (options.solution) return showSolution(project, exercise);
  const fs::path folder = project.outFolder(exercise, false);
  const std::vector<fs::path> replays = filesIn(folder, ".html");
  for (const fs::path& replay : replays)
    say(fmt::format("replay   {}\n         {}", shown(replay), urlOf(replay)));
  for (const char* kind : {".mp4", ".webm", ".gif"})
    for (const fs::path& film : filesIn(folder, kind)) say("film     " + shown(film));
  const auto pictures = filesIn(folder, ".png");
  for (const std::string& line : shortList(pictures)) say("picture  " + line);
  const fs::path results = folder / "results.json";
  if (fs::exists(results)) say("result   " + shown(results));
  if (!replays.empty() || !pictures.empty() || fs::exists(results)) return ExitCode::kFull;
  say(fmt::format("There is nothing in {} yet. `scripts/rex run {}` draws pictures and replays.",
                  shown(folder), exercise.name));
  return ExitCode::kBelow;
}

void addShow(CLI::App* command, Action& action) {
  const auto options = std::make_shared<ShowOptions>();
  command->footer("Examples:\n  scripts/rex show 01\n  scripts/rex show 01 --solution");
  addExercise(command, options->exercise);
  addOptions(command,
             {{"--solution", options->solution, "print the reference solution, if the course allows it"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return show(p, *options); }; });
}

}  // namespace rex::cli
