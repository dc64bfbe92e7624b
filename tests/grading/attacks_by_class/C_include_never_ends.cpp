// Includes the descriptors of the compiler itself, and a device that never ends, each by a path through proc.
// It is not meant to compile.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

#if __has_include("/proc/self/fd/0")
#include "/proc/self/fd/0"
#endif
#if __has_include("/proc/thread-self/fd/2")
#include "/proc/thread-self/fd/2"
#endif
#if __has_include("/dev/ptmx")
#include "/dev/ptmx"
#endif
#include "/dev/zero"
