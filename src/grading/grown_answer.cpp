#include "grading/grown_answer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grading/answer_value.h"
#include "grading/remembered_answer.h"

namespace rex::grading {
namespace {

constexpr double kPlainFactor = 3, kWrongShare = 0.01;

void multiply(AnswerValue& answer, double factor) {
  forEachNumber(answer, [&](double& x) { x *= factor; });
}

// Zero becomes huge, too.
void growOne(AnswerValue& answer, double place, double factor) {
  std::vector<double*> numbers;
  forEachNumber(answer, [&](double& x) { numbers.push_back(&x); });
  if (numbers.empty()) return;
  const auto at = static_cast<std::size_t>(place * static_cast<double>(numbers.size()));
  double& x = *numbers[std::min(at, numbers.size() - 1)];
  x = factor * (std::abs(x) > 1e-6 ? x : 1);
}

void makeWrong(AnswerValue& value) {
  forEachNumber(value, [](double& x) { x += kWrongShare * (1 + std::abs(x)); });
}

// One more row of that number.
void addRow(AnswerValue& matrix, double number) {
  if (matrix.parts.empty() || matrix.parts[0].kind != 'd' || matrix.fixedRows >= 0) return;
  std::vector<AnswerValue> parts;
  for (std::size_t k = 0; k < matrix.parts.size(); ++k) {
    parts.push_back(matrix.parts[k]);
    if ((k + 1) % static_cast<std::size_t>(matrix.rows) != 0) continue;
    parts.push_back(matrix.parts[k]);
    parts.back().number = number;
  }
  matrix.parts = std::move(parts);
  ++matrix.rows;
}

// One more row of each matrix and one more element of each list, huge.
void addEntries(AnswerValue& value, double number) {
  for (AnswerValue& part : value.parts) addEntries(part, number);
  if (value.kind == 'M') addRow(value, number);
  if (value.kind != '[' || value.parts.empty()) return;
  value.parts.push_back(value.parts.back());
  forEachNumber(value.parts.back(), [&](double& x) { x = number; });
}

// A value and its Jacobian get a component whose Jacobian is right, and the other rows are wrong.
void grow(AnswerValue& answer, double number, const Change& change) {
  const auto pair = valueAndJacobianOf(answer);
  if (!pair) {
    makeWrong(answer);
    if (!change.isPlain) addEntries(answer, number);
    return;
  }
  makeWrong(*pair->J);
  if (change.isPlain) return;
  addRow(*pair->y, number);
  addRow(*pair->J, change.factor);
}

double sumOf(std::vector<AnswerValue> question) {
  double sum = 0;
  for (AnswerValue& one : question) forEachNumber(one, [&](double& x) { sum += x; });
  return sum;
}

}  // namespace

std::string toString(Growth growth) {
  constexpr std::array<const char*, static_cast<std::size_t>(Growth::kCount)> kNames = {"huge", "tiny",
                                                                                        "one huge", "steep"};
  return kNames.at(static_cast<std::size_t>(growth));
}

std::vector<std::byte> grown(std::span<const std::byte> answer, std::span<const std::byte> arguments,
                             const std::vector<std::string>& layouts, const Change& change) {
  if (layouts.front().empty()) return {};
  AnswerValue value = readAnswer(answer, layouts.front());
  const double factor = change.isPlain ? kPlainFactor : change.factor;
  switch (change.growth) {
    case Growth::kHuge:
      multiply(value, factor);
      break;
    case Growth::kTiny:
      multiply(value, 1 / factor);
      break;
    case Growth::kOneHuge:
      growOne(value, change.place, factor);
      break;
    case Growth::kSteep:
    case Growth::kCount:
      grow(value, factor * (1 + sumOf(argumentsOf(arguments, layouts))), change);
      break;
  }
  return bytesOf(value);
}

}  // namespace rex::grading
