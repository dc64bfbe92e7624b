#include "cli/sandbox_choice.h"

#include <fmt/format.h>

#include "base/folders.h"
#include "cli/out_folder.h"
#include "cli/terminal.h"
#include "sandbox/probes.h"

namespace rex::cli {

std::filesystem::path launcherPath(const Project& project) { return project.build / "rex-sandbox"; }

std::filesystem::path probePath(const Project& project) { return project.build / "rex-sandbox-probe"; }

std::optional<sandbox::Sandbox> chooseSandbox(const Project& project, std::optional<sandbox::Level> level) {
  sandbox::Sandbox chosen{.level = level.value_or(sandbox::Level::kLimitsOnly),
                          .launcher = launcherPath(project)};
  if (!isConfined(chosen.level)) return chosen;
  const PrivateFolder folder(temporaryFolder());
  const std::string reason = sandbox::whyNot(chosen, probePath(project), folder.path());
  if (reason.empty()) return chosen;
  note(wrap(
      fmt::format("sandbox level {} is not available here: {}", numberOf(*level), escapeForTerminal(reason)),
      0, 0));
  return {};
}

}  // namespace rex::cli
