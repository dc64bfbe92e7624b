// Includes itself once, by the depth of includes; the second time it is a header of the system without
// warnings.
#if __INCLUDE_LEVEL__ == 0
#include "exercise.h"
#include __FILE__
int main() {}
#else
#pragma GCC system_header
double twice(double) {
  int unused;
  return 0;
}
std::vector<double> squares(int) { return {}; }
#endif
