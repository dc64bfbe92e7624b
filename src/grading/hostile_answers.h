#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grading/grade.h"
#include "grading/spoilt_answer.h"

namespace rex::grading {

/// Of each function of the student's the layout of what it returns, and those of its arguments.
using CallLayouts = std::vector<std::vector<std::string>>;

/// What hostile answers did to one check.
struct HostileOutcome {
  std::string check;
  Hostility hostility = Hostility::kEmpty;
  std::int64_t answers = 0;
  int runs = 0;
  int mostPoints = 0;       ///< of a run in which no answer was left as it was
  int runsWithPoints = 0;   ///< of those
  int unjudged = 0;         ///< runs that ended by an exception of the check
  std::string exception{};  ///< of the first of these
  double mostSeconds = 0;   ///< of the processor, of one run
  std::string crash{};      ///< how the process ended; empty: it did not
};

/// Records what the job's worker, that of the reference solution, answers, then gives the checks at least
/// `answers` hostile ones, as many of each kind to each check, without a worker, in copies of this process.
[[nodiscard]] std::vector<HostileOutcome> giveHostileAnswers(std::span<const RunnableCheck> checks,
                                                             const GradingJob& job, std::uint64_t signature,
                                                             const CallLayouts& layouts,
                                                             std::int64_t answers);

/// Generic liars: functions that return zeros, always the same answer, that of the last call, or what they
/// were given, in the right shape.
enum class Lie { kZeros, kConstant, kLastAnswer, kEcho, kCount };

[[nodiscard]] std::string toString(Lie lie);

/// What a check gives for a lie.
struct LieOutcome {
  std::string check, part;
  Lie lie = Lie::kZeros;
  int points = 0;
};

/// Has the reference solution's worker tell each lie to each check.
[[nodiscard]] std::vector<LieOutcome> tellLies(std::span<const RunnableCheck> checks, const GradingJob& job,
                                               std::uint64_t signature, const CallLayouts& layouts);

}  // namespace rex::grading
