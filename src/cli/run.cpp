#include <algorithm>
#include <csignal>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <string.h>

#include "base/process.h"
#include "cli/commands.h"
#include "cli/student_file.h"
#include "cli/terminal.h"
#include "grading/private_folder.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// Names every file below the folder; long runs of one kind only by their ends.
void listResults(const fs::path& folder) {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> groups;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = entry.path().lexically_relative(folder);
    if (name.string().starts_with('.')) continue;
    groups[{name.parent_path().string(), name.extension().string()}].push_back(shown(entry.path()));
  }
  if (groups.empty()) return;
  say("\nWhat lies in " + shown(folder) + ":");
  constexpr std::size_t kListed = 6;
  for (auto& [kind, files] : groups) {
    std::sort(files.begin(), files.end());
    if (files.size() > kListed)
      say(fmt::format("  {} ... {} ({} files)", files.front(), fs::path(files.back()).filename().string(),
                      files.size()));
    else
      for (const std::string& file : files) say("  " + file);
  }
}

}  // namespace

ExitCode run(const Project& project, const RunOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const fs::path file = chooseStudentFile(exercise, options.solution);
  const fs::path out =
      fs::absolute(options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  fs::create_directories(out);
  fs::create_directories(project.buildFolder(exercise));
  const grading::PrivateFolder work(project.buildFolder(exercise));
  const auto program = buildProgram(project, exercise, {.main = file, .workFolder = work.path()}, out);
  if (!program) return ExitCode::kNotGradable;

  std::fflush(stdout);
  constexpr double kNoTimeout = 1e6;
  const ProcessResult result =
      runProcess({program->string()}, {.directory = out, .timeout = kNoTimeout, .inheritOutput = true});
  listResults(out);
  if (result.ok()) return ExitCode::kFull;
  if (result.signal != 0) {
    note(
        fmt::format("\nThe program was ended by signal {} ({}).", result.signal, ::strsignal(result.signal)));
    if (result.signal != SIGINT) note(fmt::format("To see where: scripts/rex debug {}", exercise.name));
  } else {
    note(fmt::format("\nThe program ended with exit code {}.", result.exitCode));
  }
  return ExitCode::kBelow;
}

}  // namespace rex::cli
