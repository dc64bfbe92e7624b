// Stops itself before it is ready, as a debugger or a machine that suspends programs would do.
#include <csignal>

#include "exercise.h"

namespace {
const bool ready = raise(SIGSTOP) == 0;
}

double twice(double x) { return ready ? 0 * x : 1; }
std::vector<double> squares(int) { return {}; }
int main() {}
