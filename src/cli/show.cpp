#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/result_list.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

ExitCode show(const Project& project, const ShowOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const fs::path folder = project.outFolder(exercise, options.solution);
  const std::vector<fs::path> replays = filesIn(folder, ".html");
  for (const fs::path& replay : replays)
    say(fmt::format("replay   {}\n         file://{}", shown(replay), fs::absolute(replay).string()));
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

}  // namespace rex::cli
