#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grading/worker_failure.h"
#include "grading/worker_limits.h"
#include "remote/caller.h"
#include "sandbox/cell.h"

namespace rex::grading {

struct WorkerOptions {
  std::filesystem::path program;  ///< the worker, an executable file
  std::uint64_t signature = 0;    ///< of the functions it must offer
  WorkerLimits limits{};
  std::filesystem::path temporaryFolder = "/tmp";  ///< its working folder is made in here
  sandbox::Sandbox sandbox{};
  std::vector<std::filesystem::path> libraries{};  ///< that the program loads, beside those of the system
};

/// What a program printed: valid as far as the program made it so.
struct CapturedText {
  std::string text{};       ///< the first 64 kB
  std::uint64_t bytes = 0;  ///< printed in all
};

/// How a worker fared. Times in seconds.
struct WorkerRun {
  std::optional<Failure> failure{};  ///< nothing: the conversation came to its end
  double cpuSeconds = 0;
  double wallSeconds = 0;  ///< that the grader waited for it
  std::int64_t peakMemoryBytes = 0;
  CapturedText output{};
  CapturedText error{};
};

/// Starts a worker in a process of its own, holds the conversation with it, and ends it with all processes it
/// made; its working folder goes too. Whatever the worker does becomes a Failure; what else the conversation
/// throws is passed on. Meanwhile the calling process must not start others: they would be taken for the
/// worker's. Throws Error if the program or its sandbox cannot be started. At sandbox level 0, limits and a
/// clock, there is no protection against a program that means harm.
[[nodiscard]] WorkerRun runWithWorker(const WorkerOptions& options,
                                      const std::function<void(remote::Caller&)>& conversation);

}  // namespace rex::grading
