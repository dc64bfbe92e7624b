// Answers with 1e9, 1.4e154 or 1.7e308 in turn, which are wrong everywhere but make products and tolerances
// overflow.
#include "exercise.h"

namespace {
int turn = 0;
const double huge[] = {1e9, 1.4e154, 1.7e308, -1.7e308, 9.007199254740993e15};
}  // namespace

double twice(double) { return huge[turn++ % 5]; }

std::vector<double> squares(int count) {
  return std::vector<double>(static_cast<std::size_t>(count), huge[turn++ % 5]);
}

int main() {}
