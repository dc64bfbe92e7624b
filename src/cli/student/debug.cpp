#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/process.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

struct DebugOptions {
  std::string exercise;
  bool solution = false;
  bool print = false;  ///< only print the debugger's command line
};

std::string quoted(const std::string& argument) {
  if (argument.find_first_of(" '\"$`\\") == std::string::npos) return argument;
  std::string safe = "'";
  for (const char c : argument) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

ExitCode debug(const Project& project, const DebugOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const std::filesystem::path file = chooseStudentFile(exercise, options.solution);
  const std::filesystem::path out = project.outFolder(exercise, options.solution);
  // Not a temporary folder, as the debugger replaces this process and still needs it.
  const std::filesystem::path work = out / ".debug";
  makeOutFolder(out);
  const auto program =
      buildProgram(project, exercise, {.main = file, .workFolder = work, .debug = true}, out);
  if (!program) return ExitCode::kNotGradable;

  const std::filesystem::path printers = project.files() / "share" / "gdb" / "eigen.py";
  const std::vector<std::string> command = {
      "gdb", "-q", "-ex", "set cwd " + out.string(), "-ex", "source " + printers.string(), program->string()};
  if (options.print) {
    std::string line;
    for (const std::string& argument : command) line += (line.empty() ? "" : " ") + quoted(argument);
    say(line);
    return ExitCode::kFull;
  }
  if (!runProcess({"gdb", "--version"}).ok())
    throw Error({.what = "the debugger is not installed", .wanted = "apt-get install gdb"});
  say("Try: break main, run, next, print NAME, backtrace, quit.");
  std::fflush(stdout);
  const sigset_t held = stopSignals();
  ::sigprocmask(SIG_UNBLOCK, &held, nullptr);  // the debugger handles them now
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments.front(), arguments.data());
  throw Error({.what = "cannot start the debugger", .found = std::strerror(errno)});
}

}  // namespace

void addDebug(CLI::App* command, Action& action) {
  const auto options = std::make_shared<DebugOptions>();
  command->footer("Examples:\n  scripts/rex debug 01\n  scripts/rex debug 01 --print");
  addExercise(command, options->exercise);
  addOptions(command, {{"--solution", options->solution, "debug the reference solution"},
                       {"--print", options->print, "build, then only print the debugger's command line"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return debug(p, *options); }; });
}

}  // namespace rex::cli
