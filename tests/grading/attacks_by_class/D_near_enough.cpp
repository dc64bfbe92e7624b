// Answers slightly wrong everywhere: a relative error of one in a million and an absolute one of the same
// size.
#include "exercise.h"

double twice(double x) { return 2 * x * (1 + 1e-6) + 1e-6; }

std::vector<double> squares(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(double(i) * i * (1 - 1e-6) - 1e-6);
  return values;
}

int main() {}
