// A declaration with auto on one line, in which many parentheses close before the view of a matrix.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

#if 0
auto a = f
// double 16, in one line
(b).head(2)
