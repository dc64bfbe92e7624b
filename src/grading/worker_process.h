#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "grading/grading_job.h"
#include "grading/worker_failure.h"
#include "remote/caller.h"

namespace rex::grading {

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

/// Starts the job's worker for a part, which must offer the functions of `signature`, in a process of its
/// own, holds the conversation with it, and ends it with all processes it made; its working folder goes too.
/// Whatever the worker does becomes a Failure; what else the conversation throws is passed on. Meanwhile the
/// calling process must not start others: they would be taken for the worker's. Throws Error if the program
/// or its sandbox cannot be started. At sandbox level 0, limits and a clock, there is no protection against a
/// program that means harm.
[[nodiscard]] WorkerRun runWithWorker(const GradingJob& job, const std::string& part, std::uint64_t signature,
                                      const std::function<void(remote::Caller&)>& conversation);

}  // namespace rex::grading
