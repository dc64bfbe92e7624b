#include "cli/student/show.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/result_list.h"
#include "cli/student/exercise_option_internal.h"
#include "cli/student/student_room_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

namespace {

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

}  // namespace

ExitCode show(const Project& project, const ShowOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const fs::path folder = project.outFolder(exercise, options.solution);
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
  const std::string solution = options.solution ? " --solution" : "";
  say(fmt::format("There is nothing in {} yet. `scripts/rex run {}{}` draws pictures and replays.",
                  shown(folder), exercise.name, solution));
  return ExitCode::kBelow;
}

void addShow(CLI::App* command, Action& action) {
  const auto options = std::make_shared<ShowOptions>();
  command->footer("Example: scripts/rex show 01");
  addExercise(command, options->exercise);
  command->add_flag("--solution", options->solution, "files of the reference solution");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return show(p, *options); }; });
}

}  // namespace rex::cli
