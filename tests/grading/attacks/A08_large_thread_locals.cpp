// The same for each thread.
#include "exercise.h"

thread_local char big[1ull << 36];

double twice(double x) { return big[static_cast<unsigned>(x)]; }
std::vector<double> squares(int) { return {}; }
int main() {}
