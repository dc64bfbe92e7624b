// Calls within calls, to be searched for the definition of the function.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

int more =
// double 16, in one line
twice(
