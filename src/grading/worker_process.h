#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "grading/grading_job.h"
#include "grading/worker_failure.h"
#include "remote/caller.h"

namespace rex::grading {

/// What a program printed, byte for byte; it need not be valid UTF-8.
struct CapturedText {
  std::string text{};       ///< the first 64 kB
  std::uint64_t bytes = 0;  ///< printed in all
};

/// The result of running a worker. Times are in seconds.
struct WorkerRun {
  std::optional<Failure> failure{};  ///< empty: the conversation reached its end
  double cpuSeconds = 0;
  double wallSeconds = 0;  ///< time the grader waited for it once it was ready
  std::int64_t peakMemoryBytes = 0;
  CapturedText output{};
  CapturedText error{};
};

/// Starts the job's worker for a part in its own process and holds the conversation with it; the worker
/// must offer the functions of `signature`. At the end the worker, all its processes and its working folder
/// are removed. Misbehaviour of the worker becomes a Failure; other exceptions of the conversation are
/// passed on. The caller must not start other processes meanwhile: they would be taken for the worker's.
/// Throws Error if the program or its sandbox cannot be started. Sandbox level 0 (limits and a clock) is no
/// protection against malicious programs. It waits `patience` times as long as the limits say; a Failure
/// because that was not enough may be of the machine: slownessOfMachine() decides.
[[nodiscard]] WorkerRun runWithWorker(const GradingJob& job, const std::string& part, std::uint64_t signature,
                                      const std::function<void(remote::Caller&)>& conversation,
                                      double patience = 1);

/// The experiment that tells whether a file or the machine is to blame for lost time: runs the job's control,
/// a worker without code of a student's, in the same sandbox under the same limits. Returns how many times
/// as long as on an idle machine its work took, at least 1; nothing if it was not ready, or did not answer,
/// in time. Without a control, returns 1.
[[nodiscard]] std::optional<double> slownessOfMachine(const GradingJob& job, std::uint64_t signature);

}  // namespace rex::grading
