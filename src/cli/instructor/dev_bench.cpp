#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/process.h"
#include "cli/instructor/dev_verbs.h"

namespace rex::cli {
ExitCode devBench(const Project& project, const BenchOptions& options) {
  const std::filesystem::path program = project.build / "tests" / "bench" / "rex_bench";
  if (!std::filesystem::exists(program))
    throw Error({.what = "the benchmarks are not built",
                 .wanted = "scripts/rex dev bench, which builds them first, in a tree with tests"});
  std::vector<std::string> command = {program.string()};
  command.insert(command.end(), options.names.begin(), options.names.end());
  if (options.json) command.push_back("--json");
  if (!options.report.empty()) command.insert(command.end(), {"--report", options.report});
  const ProcessResult result = runProcess(command, {.timeout = 3600, .inheritOutput = true});
  if (result.exitCode == static_cast<int>(ExitCode::kUsage)) return ExitCode::kUsage;
  if (!result.started || result.signal != 0)
    throw Error({.what = "the benchmarks were ended by a signal or did not start"});
  return result.ok() ? ExitCode::kFull : ExitCode::kGraderFault;
}

}  // namespace rex::cli
