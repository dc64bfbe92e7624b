#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grading/answer_value.h"
#include "grading/grade.h"
#include "grading/hostile_answers.h"

namespace rex::grading {

/// What a program answers that solves only the first question, and invents a slope by which all later
/// answers follow from it: y = y_first + S (x - x_first), where x are all numbers of the question. An answer
/// of a vector and a matrix with as many rows is taken for a value and its Jacobian by a vector of the
/// question; the Jacobian is then the invented slope from the first answer on, so that differences of y
/// agree with it. A question or an answer of other sizes is a first one again.
class RememberedAnswer {
 public:
  /// `layouts` are those of the answer and of each argument.
  [[nodiscard]] std::vector<std::byte> answer(std::span<const std::byte> arguments,
                                              std::span<const std::byte> honest,
                                              const std::vector<std::string>& layouts);

 private:
  void remember(AnswerValue honest, std::vector<AnswerValue> question);

  std::optional<AnswerValue> first_{};
  std::vector<AnswerValue> question_{};
};

/// The value of an answer that consists of a value and its Jacobian, and the Jacobian.
struct ValueAndJacobian {
  AnswerValue* y = nullptr;
  AnswerValue* J = nullptr;
};

/// Empty unless the answer is a struct with one column of n numbers and a matrix of n rows.
[[nodiscard]] std::optional<ValueAndJacobian> asValueAndJacobian(AnswerValue& answer);

/// The arguments of a call, taken apart.
[[nodiscard]] std::vector<AnswerValue> readArguments(std::span<const std::byte> bytes,
                                                     const std::vector<std::string>& layouts);

/// Ways in which an answer could make more room for itself: all of its numbers huge, all of them tiny, one
/// of them huge, or one more entry, row and list element, steep in every number of the question, beside
/// numbers that are one per cent wrong.
enum class Growth { kHuge, kTiny, kOneHuge, kSteep, kCount };

[[nodiscard]] std::string toString(Growth growth);

/// How an answer is changed; the same change of every answer of a function.
struct Change {
  Growth growth = Growth::kHuge;
  /// Whether the same numbers are only made wrong: three times as large, a third, or without the entries.
  bool isPlain = false;
  double place = 0;     ///< of the one huge number among all, from 0 to 1
  double factor = 1e9;  ///< what is huge
};

/// The honest answer, changed. `layouts` are those of the answer and of each argument (remote/layout.h).
/// An answer without such numbers, or of a fixed size, stays as it is. Throws Error if `answer` or
/// `arguments` do not have these layouts.
[[nodiscard]] std::vector<std::byte> grownAnswer(std::span<const std::byte> answer,
                                                 std::span<const std::byte> arguments,
                                                 const std::vector<std::string>& layouts,
                                                 const Change& change);

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
