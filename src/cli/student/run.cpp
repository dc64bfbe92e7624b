#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string.h>

#include "base/private_folder.h"
#include "base/process.h"
#include "cli/out_folder.h"
#include "cli/result_list.h"
#include "cli/student/exercise_option_internal.h"
#include "cli/student/student_file.h"
#include "cli/student/student_room_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string exercise;
  bool solution = false;
  std::filesystem::path out;  ///< empty: out/EXERCISE, or out/EXERCISE-solution
};

void listResults(const fs::path& folder) {
  const std::vector<std::string> files = shortList(filesIn(folder));
  if (!files.empty()) say("\nWhat lies in " + shown(folder) + ":");
  for (const std::string& line : files) say("  " + line);
}

ExitCode run(const Project& project, const RunOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const fs::path file = chooseStudentFile(exercise, options.solution);
  const fs::path out =
      fs::absolute(options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  makeOutFolder(out);
  fs::create_directories(project.buildFolder(exercise));
  const PrivateFolder work(project.buildFolder(exercise));
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

}  // namespace

void addRun(CLI::App* command, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  command->footer(
      "Examples:\n  scripts/rex run 01\n  scripts/rex run 01 --solution -o /tmp/look\n\n"
      "The program runs inside the output folder; frames and plots land there.");
  addExercise(command, options->exercise);
  command->add_flag("--solution", options->solution, "run the reference solution instead of main.cpp");
  command->add_option("-o,--out", options->out, kOutHelp)->type_name("DIR");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return run(p, *options); }; });
}

}  // namespace rex::cli
