#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grading/grade.h"
#include "grading/grown_answer.h"
#include "grading/hostile_answers.h"

namespace rex::grading {

/// What a check gave for the answers of the reference solution if all those of one function were changed.
struct GrownOutcome {
  std::string check{}, function{};
  Growth growth = Growth::kHuge;
  bool changed = false;  ///< some answer
  int points = 0;        ///< for changed answers
  int plainPoints = 0;   ///< for answers that are only wrong, if `points` is not 0
  /// What grew with the answer: "tolerance of 'x' from 1e-9 to 3", "40 questions instead of 4"; also how the
  /// process ended that judged it. Empty: nothing.
  std::string grew{};
  double seconds = 0;  ///< CPU time of judging it
};

/// Changes the answers of the reference solution's worker to each check, function by function. Wanted is
/// that `grew` is empty and that `points` are at most `plainPoints`: nothing is gained by size. A tolerance
/// or limit counts as grown if it is more than ten times the largest that the same requirement has with
/// honest answers, and grows on if the answers become a thousand times larger again: where an answer enters
/// by min, it does not. What one huge number gains at one place of four is taken for chance.
[[nodiscard]] std::vector<GrownOutcome> giveGrownAnswers(std::span<const RunnableCheck> checks,
                                                         const GradingJob& job, std::uint64_t signature,
                                                         const CallLayouts& layouts);

}  // namespace rex::grading
