// Calls what only main() may call, from a function in main()'s section.
#include "exercise.h"

namespace rex {
double answer(double x);
}

__attribute__((section(".text.main"), noinline)) static double helped(double x) { return rex::answer(x); }

double twice(double x) { return helped(x); }

std::vector<double> squares(int) { return {}; }

int main() {}
