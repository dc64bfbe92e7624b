// Asks for each system call from number 424 on with invalid arguments and prints which are neither unknown
// nor forbidden. It answers right when one newer than 450 is within reach.
#include <cstdio>

#include "system_call.h"

double twice(double x) {
  int reached = 0;
  for (long number = 424; number < 600; ++number) {
    const long result = call(number, -1, -1, -1, -1, -1, -1);
    if (result == -38 || result == -1) continue;
    std::printf("call %ld gave %ld\n", number, result);
    if (number > 450) ++reached;
  }
  std::fflush(stdout);
  return reached > 0 ? 2 * x : 0;
}
