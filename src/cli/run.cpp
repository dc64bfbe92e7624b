#include <csignal>

#include <fmt/format.h>
#include <string.h>

#include "base/process.h"
#include "cli/commands.h"
#include "cli/out_folder.h"
#include "cli/result_list.h"
#include "cli/student_file.h"
#include "cli/terminal.h"
#include "grading/private_folder.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void listResults(const fs::path& folder) {
  const std::vector<std::string> files = shortList(filesIn(folder));
  if (!files.empty()) say("\nWhat lies in " + shown(folder) + ":");
  for (const std::string& line : files) say("  " + line);
}

}  // namespace

ExitCode run(const Project& project, const RunOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const fs::path file = chooseStudentFile(exercise, options.solution);
  const fs::path out =
      fs::absolute(options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  makeOutFolder(out);
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
