#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/private_folder.h"
#include "cli/out_folder.h"
#include "cli/robot/doctor.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "sandbox/probes.h"

namespace rex::cli {
namespace {

using sandbox::Probe;

struct Trial {
  sandbox::Level level{};
  std::vector<Probe> probes{};
};

// The highest level at which all attacks fail, or the last one tried.
Trial tryLevels(const Project& project, sandbox::Level highest) {
  const PrivateFolder folder(temporaryFolder());
  Trial trial;
  for (const sandbox::Level level : sandbox::kConfiningLevels) {
    if (level > highest) continue;
    trial.probes = sandbox::attack({level, launcherOf(project)}, probeOf(project), folder.path());
    if (std::all_of(trial.probes.begin(), trial.probes.end(), [](const Probe& p) { return p.held; })) {
      trial.level = level;
      break;
    }
    const auto broken =
        std::find_if(trial.probes.begin(), trial.probes.end(), [](const Probe& p) { return !p.held; });
    note(wrap(fmt::format("level {} does not hold here: {}{}", numberOf(level),
                          broken->ran ? broken->name + ": " : "", harmless(broken->text)),
              2, 0));
  }
  return trial;
}

void sayTrial(const Trial& trial) {
  for (const Probe& probe : trial.probes)
    say(fmt::format("{:<10}  {}  {}", probe.name,
                    probe.held ? paint(Colour::kGreen, "held ") : paint(Colour::kRed, "fails"),
                    harmless(probe.text)));
  say(paint(Colour::kBold, describe(trial.level)));
  if (const std::string warning = sandbox::warningOf(trial.level); !warning.empty()) say(wrap(warning, 0, 0));
}

void sayTrialAsJson(const Trial& trial, bool ok) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Probe& probe : trial.probes)
    rows.push_back({{"name", probe.name}, {"held", probe.held}, {"text", probe.text}});
  say(nlohmann::json{{"level", numberOf(trial.level)}, {"probes", rows}, {"ok", ok}}.dump(2));
}

}  // namespace

ExitCode doctorOfSandbox(const Project& project, const DoctorOptions& options) {
  const Trial trial = tryLevels(project, options.level.value_or(sandbox::Level::kControlGroup));
  const bool ok = trial.level >= options.level.value_or(sandbox::Level::kFiles);
  options.json ? sayTrialAsJson(trial, ok) : sayTrial(trial);
  return ok ? ExitCode::kFull : ExitCode::kWeakSandbox;
}

}  // namespace rex::cli
