// Computes without end while compiling.
#include "exercise.h"

constexpr double sum() {
  double result = 0;
  for (long k = 0; k < 100000000000000; ++k) result += 1;
  return result;
}
constexpr double kSum = sum();

double twice(double) { return kSum; }
std::vector<double> squares(int) { return {}; }
int main() {}
