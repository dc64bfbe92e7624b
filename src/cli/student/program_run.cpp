#include "cli/student/program_run.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <string.h>

#include "base/private_folder.h"
#include "base/process.h"
#include "cli/out_folder.h"
#include "cli/result_list.h"
#include "cli/student/own_program.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// Lists what was written since then: older files show what an earlier program did.
void listResults(const fs::path& folder, fs::file_time_type since) {
  std::vector<fs::path> written = filesIn(folder);
  std::erase_if(written, [&](const fs::path& file) { return fs::last_write_time(file) < since; });
  const std::vector<std::string> files = shortList(written);
  if (!files.empty()) say("\nFiles in " + shown(folder) + ":");
  for (const std::string& line : files) say("  " + line);
}

}  // namespace

Ended runIn(const std::vector<std::string>& command, const OwnRun& options) {
  std::fflush(stdout);
  constexpr double kNoTimeout = 1e6;
  // The times of files come from a coarser clock.
  const auto start = fs::file_time_type::clock::now() - std::chrono::milliseconds(20);
  const ProcessResult result = runProcess(command, {.directory = options.out,
                                                    .environment = options.environment,
                                                    .timeout = kNoTimeout,
                                                    .inheritOutput = true,
                                                    .cpuSeconds = static_cast<double>(options.seconds)});
  if (options.listsFiles) listResults(options.out, start);
  if (result.ok()) return Ended::kWell;
  if (result.signal == 0) {
    note(fmt::format("\nThe program ended with exit code {}.", result.exitCode));
    return Ended::kBadly;
  }
  if (result.signal == SIGXCPU || (result.signal == SIGKILL && result.cpuSeconds >= options.seconds)) {
    note(fmt::format("\nThe program was stopped after {} s of CPU time; --time-limit S allows more.",
                     options.seconds));
    return Ended::kTooLate;
  }
  note(fmt::format("\nThe program was ended by signal {} ({}).", result.signal, ::strsignal(result.signal)));
  return result.signal == SIGINT ? Ended::kBadly : Ended::kCrashed;
}

ExitCode codeOf(Ended ended) { return ended == Ended::kWell ? ExitCode::kFull : ExitCode::kBelow; }

ExitCode runOwnProgram(const Project& project, const fs::path& file, const OwnRun& options) {
  makeOutFolder(options.out);
  const PrivateFolder work(project.workPlace("student"));
  const auto program = buildOwnProgram(project, file, work.path(), options.out);
  if (!program) return ExitCode::kNotGradable;
  std::vector<std::string> command = {program->string()};
  command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  return codeOf(runIn(command, options));
}

}  // namespace rex::cli
