#include "exercise.h"

double twice(double x) { return 2 * x; }

std::vector<double> squares(int count) {
  std::vector<double> result;
  for (int k = 0; k < count; ++k) result.push_back(k * k);
  return result;
}
