// Works for a while, then waits for a file that never ends. It is not meant to compile.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

constexpr int worked(int n) {
  int sum = 0;
  for (int k = 0; k < n; ++k) sum += k % 7;
  return sum;
}
static_assert(worked(200000) + worked(200001) + worked(200002) + worked(200003) > 0);

#if __has_include("/proc/self/fd/2")
#include "/proc/self/fd/2"
#endif
#if __has_include("/proc/self/fd/0")
#include "/proc/self/fd/0"
#endif
#error the end
