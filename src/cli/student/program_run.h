#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

enum class Ended { kWell, kBadly, kCrashed, kTooLate };

struct OwnRun {
  std::filesystem::path out{};  ///< the folder it runs in, which is made
  std::vector<std::string> arguments{};
  int seconds = 120;                       ///< of CPU time
  std::vector<std::string> environment{};  ///< NAME=VALUE
  bool listsFiles = true;                  ///< those it wrote
};

/// Runs the command with these settings, and waits for it.
[[nodiscard]] Ended runIn(const std::vector<std::string>& command, const OwnRun& options);

[[nodiscard]] ExitCode codeOf(Ended ended);

/// Builds a program by buildOwnProgram() and runs it by runIn(). Throws as buildOwnProgram() and
/// makeOutFolder().
[[nodiscard]] ExitCode runOwnProgram(const Project& project, const std::filesystem::path& file,
                                     const OwnRun& options);

}  // namespace rex::cli
