// Wrong numbers beside one that is so large that a tolerance relative to the largest entry takes them.
#include "exercise.h"

double twice(double x) { return x + 1e9; }

std::vector<double> squares(int count) {
  std::vector<double> result(static_cast<std::size_t>(count), 7);
  if (count > 0) result.back() = 1e99;
  return result;
}

int main() {}
