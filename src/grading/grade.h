#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/grading_job.h"
#include "grading/results.h"
#include "remote/caller.h"

namespace rex::grading {

/// A check that knows how to talk to the worker.
struct RunnableCheck {
  CheckInfo info{};
  std::function<void(Check&, remote::Caller&)> run{};
};

/// Of the processor, that judging one check may take, with its pictures: ten times what a reference solution
/// needs. Memory is limited, too.
inline constexpr int kJudgingSeconds = 30;

/// Writes into the result at which sandbox level student code ran, and what that level does not stop.
void setSandbox(GradeResult& result, sandbox::Level level);

/// Runs each check, whatever job.checks says, in a fresh worker that offers the functions of `signature`, and
/// in a copy of this process, under limits, and adds the results, in
/// the given order, to `result`, whose other fields about the submission are kept. Calls `save` before the
/// first check, when everything still counts as a fault of the grader, and after each. What a check function
/// throws itself is such a fault too, and so is the death of its copy; but once it has read a value of the
/// student's, the check fails instead.
[[nodiscard]] GradeResult grade(GradeResult result, std::span<const RunnableCheck> checks,
                                const GradingJob& job, std::uint64_t signature,
                                const std::function<void(const GradeResult&)>& save);

}  // namespace rex::grading
