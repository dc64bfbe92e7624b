#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/grading_job.h"
#include "grading/results.h"
#include "grading/sketch.h"
#include "remote/caller.h"

namespace rex::grading {

/// A check that knows how to talk to the worker.
struct RunnableCheck {
  CheckInfo info{};
  std::function<void(Check&, remote::Caller&)> run{};
};

/// The CPU seconds that judging one check may take, including its pictures: ten times what a reference
/// solution needs. Memory is limited, too.
inline constexpr int kJudgingSeconds = 30;

/// Records in the result the sandbox level at which student code ran, and what that level does not prevent.
void setSandbox(GradeResult& result, sandbox::Level level);

/// Runs every check, whatever job.checks says, with a fresh worker for `signature` and in a limited copy of
/// this process. Adds the results in the given order to `result` and keeps its other fields. Calls `save`
/// after each check and before the first, when everything still counts as a grader error. An exception of a
/// check function is a grader error, too; once it has read a student's value, the check fails instead. The
/// death of a copy is the student's fault. With layouts, visible checks ask about the known mistakes of the
/// job. Throws Error if the second pass gets no result of the first.
[[nodiscard]] GradeResult grade(GradeResult result, std::span<const RunnableCheck> checks,
                                const GradingJob& job, std::uint64_t signature,
                                const std::function<void(const GradeResult&)>& save,
                                const CallLayouts& layouts = {});

}  // namespace rex::grading
