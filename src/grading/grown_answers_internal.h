#pragma once

#include <cstdint>
#include <functional>

#include "grading/check.h"
#include "grading/grade.h"
#include "grading/grading_job.h"
#include "grading/worker_process.h"
#include "remote/caller.h"

namespace rex::grading {

/// A job whose worker is the reference solution, and the signature of the functions that it offers.
struct Reference {
  const GradingJob& job;
  std::uint64_t signature = 0;
};

/// What tampers with the answers of one worker: that which a check begins with, or a fresh one.
using TamperOf = std::function<remote::Caller::Tamper(const remote::Caller&)>;

/// The result of a check whose workers, those of the reference solution, are tampered with. Throws Error if
/// a worker fails; exceptions of the check are passed on.
[[nodiscard]] CheckResult judgeTampered(const RunnableCheck& check, const Reference& reference, Check& judge,
                                        const TamperOf& tamperOf);

}  // namespace rex::grading
