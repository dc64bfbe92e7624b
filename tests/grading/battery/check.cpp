#include <numeric>

#include "interface.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

// The examples of the task.
void doublesExamples(Check& check, Student& student) {
  check.forEachCase(
      5, [&](int k) { check.near("twice the example", student.twice(k + 1), 2 * (k + 1), 1e-12); });
}

void listsSquares(Check& check, Student& student) {
  const std::vector<double> got = student.squares(4);
  check.that("there are four squares", got.size() == 4);
  for (int k = 0; k < 4; ++k) check.near("square", got[static_cast<std::size_t>(k)], k * k, 1e-12);
}

// Every number twice, in an order that nobody knows.
void doublesUnseen(Check& check, Student& student) {
  std::vector<double> numbers(20);
  for (double& number : numbers) number = check.rng().uniform(-100, 100);
  std::vector<std::size_t> order(2 * numbers.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t k = order.size(); k > 1; --k)
    std::swap(order[k - 1], order[static_cast<std::size_t>(check.rng().uniform(0, static_cast<double>(k)))]);
  for (const std::size_t k : order) {
    const double number = numbers[k % numbers.size()];
    check.near("twice an unseen number", student.twice(number), 2 * number, 1e-12);
  }
}

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"examples", "a", "The examples are doubled", 4, Group::kVisible, doublesExamples},
      {"squares", "a", "Numbers are squared", 2, Group::kVisible, listsSquares},
      {"unseen", "a", "Unseen numbers are doubled", 4, Group::kHidden, doublesUnseen},
  };
}
