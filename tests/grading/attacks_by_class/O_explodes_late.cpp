// Begins right and then explodes, each answer a million times the one before: what is compared with the
// largest number of all hides the last steps.
#include "exercise.h"

namespace {
double size = 1e-6;
}

double twice(double x) {
  size = size < 1e90 ? size * 1e6 : size;
  return size > 1e9 ? size : 2 * x;
}

std::vector<double> squares(int count) {
  std::vector<double> result;
  double entry = 0;
  for (int k = 0; k < count; ++k, entry = 1e6 * entry + 1) result.push_back(entry);
  return result;
}

int main() {}
