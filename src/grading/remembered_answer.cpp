#include "grading/remembered_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rex::grading {
namespace {

constexpr double kSteeper = 1.5;  // than the right Jacobian, whose columns change places

bool isNumbers(const AnswerValue& value) {
  return (value.kind == 'M' || value.kind == '[') && !value.parts.empty() && value.parts[0].kind == 'd';
}

std::vector<double> numbersOf(std::vector<AnswerValue>& values) {
  std::vector<double> numbers;
  for (AnswerValue& value : values) forEachNumber(value, [&](double& x) { numbers.push_back(x); });
  return numbers;
}

bool haveSameSizes(const AnswerValue& a, const AnswerValue& b) {
  return a.kind == b.kind && a.rows == b.rows && a.cols == b.cols &&
         std::ranges::equal(a.parts, b.parts, haveSameSizes);
}

// Where the numbers of the last column or list of `size` numbers begin among all of the question.
std::optional<std::size_t> beginOfBlock(const AnswerValue& value, std::size_t size, std::size_t& at) {
  std::optional<std::size_t> begin;
  if (isNumbers(value) && value.parts.size() == size && value.cols <= 1) begin = at;
  if (value.kind == 'd' || value.kind == 'f') ++at;
  for (const AnswerValue& part : value.parts)
    if (const auto within = beginOfBlock(part, size, at)) begin = within;
  return begin;
}

// Zero based columns of J in the reverse order.
void choose(AnswerValue& J) {
  const auto rows = static_cast<std::size_t>(J.rows);
  std::vector<AnswerValue> chosen;
  for (std::size_t k = J.parts.size(); k > 0; k -= rows)
    for (std::size_t row = 0; row < rows; ++row) {
      chosen.push_back(J.parts[k - rows + row]);
      chosen.back().number *= kSteeper;
    }
  J.parts = std::move(chosen);
}

}  // namespace

std::optional<ValueAndJacobian> valueAndJacobianOf(AnswerValue& answer) {
  ValueAndJacobian found;
  for (AnswerValue& part : answer.parts) {
    if (answer.kind != '(' || part.kind != 'M' || !isNumbers(part)) continue;
    if (part.cols == 1 && found.y == nullptr)
      found.y = &part;
    else if (found.y != nullptr && found.J == nullptr && part.rows == found.y->rows)
      found.J = &part;
  }
  if (found.J == nullptr) return {};
  return found;
}

std::vector<AnswerValue> argumentsOf(std::span<const std::byte> bytes,
                                     const std::vector<std::string>& layouts) {
  std::vector<AnswerValue> values;
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = sizeOfValue(bytes, layouts[k]);
    values.push_back(readAnswer(bytes.first(size), layouts[k]));
    bytes = bytes.subspan(size);
  }
  return values;
}

void RememberedAnswer::remember(AnswerValue honest, std::vector<AnswerValue> question) {
  if (const auto pair = valueAndJacobianOf(honest)) choose(*pair->J);
  first_ = std::move(honest);
  question_ = std::move(question);
}

std::vector<std::byte> RememberedAnswer::answer(std::span<const std::byte> arguments,
                                                std::span<const std::byte> honest,
                                                const std::vector<std::string>& layouts) {
  if (layouts.front().empty()) return {};
  std::vector<AnswerValue> question = argumentsOf(arguments, layouts);
  AnswerValue right = readAnswer(honest, layouts.front());
  if (!first_ || !haveSameSizes(*first_, right) || !std::ranges::equal(question_, question, haveSameSizes)) {
    remember(std::move(right), std::move(question));
    return bytesOf(*first_);
  }
  const std::vector<double> x = numbersOf(question), x0 = numbersOf(question_);
  AnswerValue said = *first_;
  const auto pair = valueAndJacobianOf(said);
  if (pair) {
    std::optional<std::size_t> begin;
    std::size_t at = 0;
    const auto rows = static_cast<std::size_t>(pair->J->rows), cols = static_cast<std::size_t>(pair->J->cols);
    for (const AnswerValue& one : question)
      if (const auto within = beginOfBlock(one, cols, at)) begin = within;
    for (std::size_t k = 0; begin && k < rows * cols; ++k)
      pair->y->parts[k % rows].number +=
          pair->J->parts[k].number * (x[*begin + k / rows] - x0[*begin + k / rows]);
  } else {
    double i = 0;
    forEachNumber(said, [&](double& y) {
      double slope = ++i;
      for (std::size_t j = 0; j < x.size(); ++j) y += .5 * std::cos(slope += 2) * (x[j] - x0[j]);
    });
  }
  return bytesOf(said);
}

}  // namespace rex::grading
