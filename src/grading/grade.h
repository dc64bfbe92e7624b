#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/results.h"
#include "grading/worker_limits.h"
#include "remote/caller.h"
#include "sandbox/cell.h"

namespace rex::grading {

/// A check that knows how to talk to the worker.
struct RunnableCheck {
  CheckInfo info{};
  std::function<void(Check&, remote::Caller&)> run{};
};

struct GradeOptions {
  std::filesystem::path
      worker{};                 ///< see workerOf(); empty: nothing is run, all checks are listed as not run
  std::uint64_t signature = 0;  ///< of the functions the worker must offer
  std::uint64_t seed = 1;
  WorkerLimits limits{};
  std::filesystem::path temporaryFolder = "/tmp";
  sandbox::Sandbox sandbox{};
  std::vector<std::filesystem::path> libraries{};  ///< that the worker loads, beside those of the system
  std::filesystem::path evidence{};  ///< folder for pictures of visible checks that do not hold; empty: none
  int jobs = 1;                      ///< checks that run at once, each in a copy of this process
  std::string secret{};  ///< of the course; empty: hidden checks take the same seed as visible ones
};

/// Of the processor, that judging one check may take, with its pictures: ten times what a reference solution
/// needs. Memory is limited, too.
inline constexpr int kJudgingSeconds = 30;

/// The program that answers the checks of a part: WORKER.PART where there is one, else WORKER.
[[nodiscard]] std::filesystem::path workerOf(const std::string& part, const std::filesystem::path& worker);

/// Writes into the result at which sandbox level student code ran, and what that level does not stop.
void setSandbox(GradeResult& result, sandbox::Level level);

/// Runs each check in a fresh worker and in a copy of this process, under limits, and adds the results, in
/// the given order, to `result`, whose other fields about the submission are kept. Calls `save` before the
/// first check, when everything still counts as a fault of the grader, and after each. What a check function
/// throws itself is such a fault too, and so is the death of its copy; but once it has read a value of the
/// student's, the check fails instead.
[[nodiscard]] GradeResult grade(GradeResult result, std::span<const RunnableCheck> checks,
                                const GradeOptions& options,
                                const std::function<void(const GradeResult&)>& save);

}  // namespace rex::grading
