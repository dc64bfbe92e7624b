// Answers right only when the sum of the letters of __DATE__, __TIME__ and __TIMESTAMP__ is even, and prints
// them.
#include <cstdio>

#include "exercise.h"

namespace {
constexpr const char* when = __DATE__ " " __TIME__ " " __TIMESTAMP__;
constexpr int sum() {
  int total = 0;
  for (const char* letter = when; *letter != 0; ++letter) total += *letter;
  return total;
}
}  // namespace

double twice(double x) {
  std::printf("compiled %s\n", when);
  return sum() % 2 == 0 ? 2 * x : 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}
