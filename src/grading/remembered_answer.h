#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grading/answer_value.h"

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
[[nodiscard]] std::optional<ValueAndJacobian> valueAndJacobianOf(AnswerValue& answer);

/// The arguments of a call, taken apart.
[[nodiscard]] std::vector<AnswerValue> argumentsOf(std::span<const std::byte> bytes,
                                                   const std::vector<std::string>& layouts);

}  // namespace rex::grading
