// Lets main() do the work, under another name.
#include "exercise.h"

namespace rex {
double answer(double x);
}

double in = 0, out = 0;

int main() { out = rex::answer(in); }

extern "C" int notMain() __attribute__((alias("main")));

double twice(double x) {
  in = x;
  notMain();
  return out;
}

std::vector<double> squares(int) { return {}; }
