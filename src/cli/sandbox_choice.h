#pragma once

#include <filesystem>
#include <optional>

#include "cli/project.h"
#include "sandbox/cell.h"

namespace rex::cli {

/// The programs that make the sandbox and attack it; they lie beside `rex`.
[[nodiscard]] std::filesystem::path launcherOf(const Project& project);
[[nodiscard]] std::filesystem::path probeOf(const Project& project);

/// The asked level if it holds here, nothing if not; what is in the way is told on standard error. Nothing
/// asked: level 0.
[[nodiscard]] std::optional<sandbox::Sandbox> chooseSandbox(const Project& project, std::optional<int> level);

/// For work of strangers: the asked level, else the best that holds here. One below 2 must be accepted by its
/// number. Nothing if there is none; why is told on standard error, and what a weak one does not stop.
[[nodiscard]] std::optional<sandbox::Sandbox> chooseForStrangers(const Project& project,
                                                                 std::optional<int> level,
                                                                 std::optional<int> accepted);

}  // namespace rex::cli
