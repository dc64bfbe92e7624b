#pragma once

#include <filesystem>
#include <optional>

#include "cli/project.h"
#include "sandbox/cell.h"

namespace rex::cli {

/// The programs that make the sandbox and attack it; they lie beside `rex`.
[[nodiscard]] std::filesystem::path launcherOf(const Project& project);
[[nodiscard]] std::filesystem::path probeOf(const Project& project);

/// The asked level if it holds here, nothing if not; what is in the way is said on standard error. Nothing
/// asked: limits only.
[[nodiscard]] std::optional<sandbox::Sandbox> chooseSandbox(const Project& project,
                                                            std::optional<sandbox::Level> level);

}  // namespace rex::cli
