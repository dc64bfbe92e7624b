#include <algorithm>
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
#include "base/text.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"
#include "grading/grading_job.h"
#include "grading/unknown_check.h"
#include "remote/worker.h"
#include "submission/submission.h"

namespace rex::cli {
namespace {

struct DebugOptions {
  std::string exercise;
  std::string check;  ///< empty: debug main()
  bool solution = false;
  bool print = false;  ///< only print the debugger's command line
};

std::string quoted(const std::string& argument) {
  if (argument.find_first_of(" '\"$`\\") == std::string::npos) return argument;
  std::string safe = "'";
  for (const char c : argument) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

// Writes the call with which the check fails into a file, and returns the name of the function; empty if the
// check passes. Without optimisation, and with all of the library, the program needs more than the limits.
std::string failingFunction(const Project& project, const ExerciseInfo& exercise, const std::string& check,
                            const std::filesystem::path& worker, const std::filesystem::path& call) {
  constexpr std::size_t kMoreMemory = 4;
  const submission::Toolchain toolchain = prepare(project, exercise);
  grading::GradingJob job{.worker = worker, .checks = {check}, .limits = exercise.limits};
  job.limits.cpuSeconds *= grading::kSanitizedSlowness;
  job.limits.memory *= kMoreMemory;
  std::vector<std::string> command = grading::toArguments(job);
  command.insert(command.begin(), toolchain.grader.string());
  command.insert(command.end(), {"--failing-call", call.string()});
  const ProcessResult run = runProcess(command, {.timeout = 4 * job.limits.wallBudget()});
  if (run.ok()) return {};
  if (run.exitCode == numberOf(ExitCode::kBelow)) return std::string(splitLines(run.output).front());
  const std::string_view said =
      std::string_view(run.error).substr(run.error.find(' ') + 1);  // after "grader:"
  throw Error({.what = fmt::format("there is no call to stop in: {}. scripts/rex test {} --check {} may say "
                                   "more",
                                   splitLines(said).front(), exercise.name, check)});
}

void requireCheck(const submission::Toolchain& toolchain, const std::string& check) {
  std::vector<std::string> ids;
  for (const grading::CheckResult& one : submission::listChecks(toolchain)) ids.push_back(one.id);
  if (std::find(ids.begin(), ids.end(), check) == ids.end()) throw grading::unknownCheck(check, ids);
}

ExitCode debug(const Project& project, const DebugOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const std::filesystem::path file = chooseStudentFile(exercise, options.solution);
  const std::filesystem::path out = project.outFolder(exercise, options.solution);
  // Not a temporary folder, as the debugger replaces this process and still needs it.
  const std::filesystem::path work = out / ".debug";
  makeOutFolder(out);
  const submission::StudentBuildOptions build{.main = file, .workFolder = work, .debug = true};
  if (!options.check.empty()) requireCheck(prepare(project, exercise), options.check);
  const auto program = options.check.empty() ? buildProgram(project, exercise, build, out)
                                             : buildWorker(project, exercise, build, out);
  if (!program) return ExitCode::kNotGradable;

  const std::filesystem::path printers = project.files() / "share" / "gdb" / "eigen.py";
  std::vector<std::string> command = {
      "gdb", "-q", "-ex", "set cwd " + out.string(), "-ex", "source " + printers.string()};
  if (!options.check.empty()) {
    const std::filesystem::path call = work / "call";
    const std::string function = failingFunction(project, exercise, options.check, *program, call);
    if (function.empty()) {
      say(fmt::format("The check passes, so there is no case to stop in: {}", options.check));
      return ExitCode::kFull;
    }
    command.insert(command.end(), {"-ex", "break -qualified " + function, "-ex",
                                   fmt::format("run {}<{} {}>/dev/null", remote::kWorkerIn,
                                               quoted(call.string()), remote::kWorkerOut)});
  }
  command.push_back(program->string());
  if (options.print) {
    std::string line;
    for (const std::string& argument : command) line += (line.empty() ? "" : " ") + quoted(argument);
    say(line);
    return ExitCode::kFull;
  }
  if (!runProcess({"gdb", "--version"}).ok())
    throw Error({.what = "the debugger is not installed", .wanted = "apt-get install gdb"});
  say(options.check.empty() ? "Try: break main, run, next, print NAME, backtrace, quit."
                            : "Try: next, print NAME, finish, backtrace, quit.");
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
  command->footer(
      "Examples:\n  scripts/rex debug 01\n  scripts/rex debug 01 --check step-hand\n\n"
      "With --check, it stops in the case that fails, where the check calls your function.");
  addExercise(command, options->exercise);
  addOptions(command, {{"--check", options->check, "NAME", "stop where this check fails, instead of main()"},
                       {"--solution", options->solution, "debug the reference solution"},
                       {"--print", options->print, "build, then only print the debugger's command line"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return debug(p, *options); }; });
}

}  // namespace rex::cli
