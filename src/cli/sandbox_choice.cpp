#include "cli/sandbox_choice.h"

#include <fmt/format.h>

#include "cli/temporary_folder.h"
#include "cli/terminal.h"
#include "grading/private_folder.h"
#include "sandbox/probes.h"

namespace rex::cli {

std::filesystem::path launcherOf(const Project& project) { return project.build / "rex-sandbox"; }

std::filesystem::path probeOf(const Project& project) { return project.build / "rex-sandbox-probe"; }

std::optional<sandbox::Sandbox> chooseSandbox(const Project& project, std::optional<int> level) {
  sandbox::Sandbox chosen{.level = level.value_or(0), .launcher = launcherOf(project)};
  if (chosen.level == 0) return chosen;
  const grading::PrivateFolder folder(temporaryFolder());
  const std::string reason = sandbox::whyNot(chosen, probeOf(project), folder.path());
  if (reason.empty()) return chosen;
  note(wrap(fmt::format("sandbox level {} cannot be had here: {}", *level, harmless(reason)), 0, 0));
  return {};
}

std::optional<sandbox::Sandbox> chooseForStrangers(const Project& project, std::optional<int> level,
                                                   std::optional<int> accepted) {
  constexpr int kBest = 3, kSafe = 2;
  if (!level) {
    const grading::PrivateFolder folder(std::filesystem::temp_directory_path());
    const auto best = sandbox::bestLevel(kBest, launcherOf(project), probeOf(project), folder.path());
    level = best.level;
    for (const std::string& reason : best.reasons)
      if (best.level < kSafe) note(wrap(harmless(reason), 2, 0));
  }
  if (*level < accepted.value_or(kSafe)) {
    note(wrap(fmt::format("sandbox level {} is not for work of strangers: {}; to grade all the same, say "
                          "--i-accept-level {}",
                          *level, sandbox::warningOf(*level), *level),
              2, 0));
    return {};
  }
  const std::optional<sandbox::Sandbox> chosen = chooseSandbox(project, level);
  if (chosen && *level < kSafe)
    note(wrap(fmt::format("sandbox level {}: {}", *level, sandbox::warningOf(*level)), 2, 0));
  return chosen;
}

}  // namespace rex::cli
