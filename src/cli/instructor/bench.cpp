#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "base/process.h"
#include "cli/instructor/instructor_room_internal.h"

namespace rex::cli {
namespace {

struct BenchOptions {
  std::vector<std::string> names;
  bool json = false;
  std::string report;
  std::string problems, urdf, srdf, seed;  ///< of the group panda
};

ExitCode bench(const Project& project, const BenchOptions& options) {
  const std::filesystem::path program = project.build / "tests" / "bench" / "rex_bench";
  if (!std::filesystem::exists(program))
    throw Error({.what = "the benchmarks are not built",
                 .wanted = "scripts/rex bench, which builds them first, in a tree with tests"});
  std::vector<std::string> command = {program.string()};
  command.insert(command.end(), options.names.begin(), options.names.end());
  if (options.json) command.push_back("--json");
  const auto pass = [&](const char* name, const std::string& value) {
    if (!value.empty()) command.insert(command.end(), {name, value});
  };
  pass("--report", options.report);
  pass("--problems", options.problems);
  pass("--urdf", options.urdf);
  pass("--srdf", options.srdf);
  pass("--seed", options.seed);
  const ProcessResult result = runProcess(command, {.timeout = 3600, .inheritOutput = true});
  if (result.exitCode == static_cast<int>(ExitCode::kUsage)) return ExitCode::kUsage;
  if (!result.started || result.signal != 0)
    throw Error({.what = "the benchmarks were ended by a signal or did not start"});
  return result.ok() ? ExitCode::kFull : ExitCode::kGraderFault;
}

}  // namespace

void addBench(CLI::App* command, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  command->footer(
      "Examples:\n  scripts/rex bench --report out/bench.html\n  scripts/rex bench kinematics --json\n"
      "  scripts/rex bench panda --problems DIR");
  command->add_option("NAME", options->names, "groups to measure (default: all)")->type_name("");
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->add_option("--report", options->report, "also write a page with figures")->type_name("FILE.html");
  command->add_option("--problems", options->problems, "panda: a folder of motion planning problems")
      ->type_name("DIR");
  command
      ->add_option("--urdf", options->urdf,
                   "panda: the robot (default: ../urdf/panda_spherized.urdf beside DIR)")
      ->type_name("FILE.urdf");
  command
      ->add_option("--srdf", options->srdf,
                   "panda: which links may collide (default: NAME.srdf beside the URDF)")
      ->type_name("FILE.srdf");
  command->add_option("--seed", options->seed, "panda: the first point of the Halton sequence (default: 1)")
      ->type_name("N");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return bench(p, *options); }; });
}

}  // namespace rex::cli
