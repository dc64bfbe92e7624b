#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "classroom/import_table.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/own_program.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"
#include "submission/student_build.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string program;  ///< an exercise, or a file
  bool solution = false;
  int seconds = 120;                   ///< of CPU time
  std::filesystem::path out;           ///< empty: out/EXERCISE, out/EXERCISE-solution or out/FILE
  std::vector<std::string> arguments;  ///< for the user's own program
};

// Whether it lies in a folder of hand-ins.
bool isOfStudent(const fs::path& file) {
  for (fs::path folder = fs::absolute(file).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    if (fs::exists(folder / classroom::kImportTable)) return true;
  return false;
}

ExitCode runFile(const Project& project, const fs::path& file, const RunOptions& options) {
  if (options.solution)
    throw UsageError({.what = "--solution", .found = shown(file), .wanted = "an exercise"});
  if (isOfStudent(file))
    note(wrap(fmt::format(
                  "{} runs with your rights: it may read and change all that you may. `rex test --main` with "
                  "--level runs its functions confined.",
                  shown(file)),
              2, 0));
  const fs::path out = fs::absolute(options.out.empty() ? programOutFolder(project, file) : options.out);
  return runOwnProgram(project, file,
                       {.out = out, .arguments = options.arguments, .seconds = options.seconds});
}

ExitCode run(const Project& project, const RunOptions& options) {
  const auto meant = programMeant(project, options.program);
  if (const fs::path* file = std::get_if<fs::path>(&meant)) return runFile(project, *file, options);
  if (!options.arguments.empty())
    throw UsageError(
        {.what = fmt::format("rex run: unknown argument '{}'", escapeForTerminal(options.arguments[0])),
         .wanted = "none with an exercise"});
  const ExerciseInfo& exercise = std::get<ExerciseInfo>(meant);
  const fs::path file = chooseStudentFile(exercise, options.solution);
  const fs::path out =
      fs::absolute(options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  makeOutFolder(out);
  const PrivateFolder work(project.workPlace("exercises/" + exercise.name));
  const auto program = buildProgram(project, exercise, {.main = file, .workFolder = work.path()}, out);
  if (!program) return ExitCode::kNotGradable;
  const OwnRun how{.out = out, .seconds = options.seconds};
  const Ended ended = runIn({program->string()}, how);
  sayWhereItEnded(prepare(project, exercise), {.main = file, .workFolder = work.path() / "again"}, how,
                  ended);
  if (ended == Ended::kCrashed) note(fmt::format("To see more: scripts/rex debug {}", exercise.name));
  return toExitCode(ended);
}

}  // namespace

void addRun(CLI::App* command, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  command->footer(
      "Examples:\n  scripts/rex run 01\n  scripts/rex run 01 --solution -o /tmp/look\n"
      "  scripts/rex run share/examples/reach.cpp\n\n"
      "Your own .cpp file may be anywhere. It may use headers next to it and the whole library,\n"
      "whose parts are built when it includes them. What follows `--` are its arguments.\n"
      "Its results go to out/NAME, those of FOLDER/main.cpp to out/FOLDER. The program runs\n"
      "in that folder, where frames and plots end up.");
  command
      ->add_option("PROGRAM", options->program, "an exercise (01, kinematics, 01-kinematics) or a .cpp file")
      ->type_name("")
      ->required();
  command->add_option("ARGUMENTS", options->arguments, "arguments of your own program, after --")
      ->type_name("");
  command->add_flag("--solution", options->solution, "run the reference solution instead of main.cpp");
  addOptions(
      command,
      {{"--time-limit", options->seconds, {1, 1'000'000}, "S", "CPU time after which the program is stopped"},
       {"-o,--out", options->out, "DIR", kOutHelp}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return run(p, *options); }; });
}

}  // namespace rex::cli
