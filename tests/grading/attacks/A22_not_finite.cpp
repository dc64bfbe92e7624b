// Numbers that are none, and numbers at the edges.
#include <limits>

#include "exercise.h"

int calls = 0;

double twice(double) {
  using Limits = std::numeric_limits<double>;
  const double values[] = {Limits::quiet_NaN(), Limits::infinity(), -0.0, 1e308, Limits::denorm_min()};
  return values[calls++ % 5];
}
std::vector<double> squares(int count) {
  return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
}
int main() {}
