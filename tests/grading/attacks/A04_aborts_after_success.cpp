// Answers rightly once, then aborts.
#include <cstdlib>

#include "exercise.h"

int calls = 0;

double twice(double x) {
  if (++calls == 2) std::abort();
  return 2 * x;
}
std::vector<double> squares(int) { return {}; }
int main() {}
