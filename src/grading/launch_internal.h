#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "grading/limits.h"
#include "sandbox/level.h"

namespace rex::grading {

/// A started process and our ends of its pipes, which do not block. The receiver owns the descriptors.
struct Launched {
  pid_t process = -1;
  int processFd = -1;  ///< readable once the process has ended
  int toWorker = -1;
  int fromWorker = -1;
  int output = -1;
  int error = -1;
  int report = -1;  ///< what the launcher says; -1 at level 0
};

/// A confinement's command, started by its launcher; without one, level 0, the program itself.
struct LaunchOrder {
  std::vector<std::string> command{};  ///< path and arguments; one path alone runs under the name "worker"
  std::string name{};                  ///< of the program, in messages
  std::filesystem::path folder{};      ///< to work in
  Limits limits{};                     ///< set here at level 0, by the launcher above
  sandbox::Level level = sandbox::Level::kLimitsOnly;
};

/// Starts it in its own process group with an empty environment, before its first instruction with its
/// limits, and with no descriptor but the standard ones, its two pipes and a launcher's report. It dies with
/// this process. Throws Error if it cannot be started.
[[nodiscard]] Launched launchWorker(const LaunchOrder& order);

}  // namespace rex::grading
