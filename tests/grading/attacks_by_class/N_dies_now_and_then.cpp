// Ends before it is ready in half of its starts, by the place where the kernel put its stack, so that a
// second attempt finds something else than the first.
#include <cstdint>
#include <cstdlib>

#include "exercise.h"

namespace {
const bool ready = [] {
  const int here = 0;
  if ((reinterpret_cast<std::uintptr_t>(&here) >> 12) % 2 == 0) std::abort();
  return true;
}();
}  // namespace

double twice(double x) { return ready ? 0 * x : 1; }
std::vector<double> squares(int) { return {}; }
int main() {}
