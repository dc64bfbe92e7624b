#pragma once

#include <filesystem>
#include <optional>

#include "cli/project.h"
#include "sandbox/cell.h"

namespace rex::cli {

/// The programs that set up the sandbox and attack it; they are next to `rex`.
[[nodiscard]] std::filesystem::path launcherPath(const Project& project);
[[nodiscard]] std::filesystem::path probePath(const Project& project);

/// The sandbox of the requested level if that holds here; otherwise empty, with the reasons on standard
/// error. Without a requested level: limits only.
[[nodiscard]] std::optional<sandbox::Sandbox> chooseSandbox(const Project& project,
                                                            std::optional<sandbox::Level> level);

}  // namespace rex::cli
