#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

enum class Ended { kWell, kBadly, kCrashed, kTooLate };

/// Runs the program in the folder `out`, waits for it and lists the files it wrote there. `environment`:
/// NAME=VALUE. `seconds` are of CPU time.
[[nodiscard]] Ended runIn(const std::filesystem::path& out, const std::vector<std::string>& command,
                          int seconds, const std::vector<std::string>& environment = {});

[[nodiscard]] ExitCode codeOf(Ended ended);

struct OwnRun {
  std::filesystem::path out{};  ///< the folder it runs in, which is made
  std::vector<std::string> arguments{};
  int seconds = 120;                       ///< of CPU time
  std::vector<std::string> environment{};  ///< NAME=VALUE
};

/// Builds a program by buildOwnProgram() and runs it by runIn(). Throws as buildOwnProgram() and
/// makeOutFolder().
[[nodiscard]] ExitCode runOwnProgram(const Project& project, const std::filesystem::path& file,
                                     const OwnRun& options);

}  // namespace rex::cli
