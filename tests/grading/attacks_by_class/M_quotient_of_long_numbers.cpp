// A quotient of numbers with very many digits, in a part that is not compiled.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

#if 0
int x = 1 /
// double 16, in one line
7
