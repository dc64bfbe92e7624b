// Spends processor time in proportion to its input, so that durations in reports tell the hidden inputs.
#include <cmath>

#include "exercise.h"

namespace {
void spend(double amount) {
  volatile double sink = 1;
  const long steps = static_cast<long>(std::fmin(std::fabs(amount), 20.0) * 3e8);
  for (long i = 0; i < steps; ++i) sink = sink * 1.0000001;
}
}  // namespace

double twice(double x) {
  spend(x);
  return 2 * x;
}

std::vector<double> squares(int count) {
  spend(count);
  return {};
}

int main() {}
