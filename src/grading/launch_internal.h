#pragma once

#include <filesystem>

#include <sys/types.h>

#include "grading/worker_limits.h"

namespace rex::grading {

/// A started process and our ends of its pipes, which do not block. The receiver owns the descriptors.
struct Launched {
  pid_t process = -1;
  int processFd = -1;  ///< readable once the process has ended
  int toWorker = -1;
  int fromWorker = -1;
  int output = -1;
  int error = -1;
};

/// Starts `program` in its own process group with an empty environment, working in `folder`, with the limits
/// set before its first instruction, and with no descriptor but the standard ones and its two pipes. It dies
/// with this process. Throws Error if it cannot be started.
[[nodiscard]] Launched launchWorker(const std::filesystem::path& program, const std::filesystem::path& folder,
                                    const WorkerLimits& limits);

}  // namespace rex::grading
