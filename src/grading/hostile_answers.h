#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/rng.h"
#include "grading/grade.h"

namespace rex::grading {

/// The ways in which an answer is made hostile: one way for all its numbers, lists and matrices, or a
/// different way for each node (`mixed`).
enum class Hostility {
  kEmpty,
  kHuge,
  kNotANumber,
  kInfinite,
  kOverflowing,
  kDenormal,
  kZero,
  kConstant,
  kRagged,
  kPermuted,
  kShifted,
  kScaled,
  kExtremeIntegers,
  kMixed,
  kCount
};

[[nodiscard]] std::string toString(Hostility hostility);

/// Whether some numbers of the honest answer stay unchanged.
[[nodiscard]] bool keepsNumbers(Hostility hostility);

/// The honest answer, corrupted: bytes of the same layout (remote/layout.h). Throws Error if `answer` does
/// not have that layout.
[[nodiscard]] std::vector<std::byte> corruptedAnswer(std::span<const std::byte> answer,
                                                     const std::string& layout, Hostility hostility,
                                                     Rng& rng);

/// What hostile answers did to one check.
struct HostileOutcome {
  std::string check;
  Hostility hostility = Hostility::kEmpty;
  std::int64_t answers = 0;
  int runs = 0;
  int mostPoints = 0;       ///< in a run in which every answer was changed
  int runsWithPoints = 0;   ///< among those runs
  int unjudged = 0;         ///< runs that ended with an exception of the check
  std::string exception{};  ///< the first of these exceptions
  double mostSeconds = 0;   ///< CPU time of the longest run
  std::string crash{};      ///< how the process ended; empty: it did not
};

/// Records the answers of the job's worker, which is that of the reference solution. Then gives the checks
/// at least `answers` hostile ones, equally many of each kind to each check, without a worker and in copies
/// of this process.
[[nodiscard]] std::vector<HostileOutcome> giveHostileAnswers(std::span<const RunnableCheck> checks,
                                                             const GradingJob& job, std::uint64_t signature,
                                                             const CallLayouts& layouts,
                                                             std::int64_t answers);

/// Generic wrong functions: they return zeros, always the same answer, the answer of the last call, their
/// input in the right shape, or what follows from the first answer by a slope of their choice
/// (`RememberedAnswer` of grown_answers.h).
enum class FalseAnswer { kZeros, kConstant, kLastAnswer, kEcho, kMemory, kCount };

[[nodiscard]] std::string toString(FalseAnswer lie);

/// The points that a check gives for a lie.
struct FalseAnswerOutcome {
  std::string check, part;
  FalseAnswer lie = FalseAnswer::kZeros;
  int points = 0;
};

/// Has the reference solution's worker tell each lie to each check.
[[nodiscard]] std::vector<FalseAnswerOutcome> runAdversarially(std::span<const RunnableCheck> checks,
                                                               const GradingJob& job, std::uint64_t signature,
                                                               const CallLayouts& layouts);

}  // namespace rex::grading
