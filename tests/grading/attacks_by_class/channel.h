// An answer that is right where receive() finds a message, and sends its input on by send(); the battery puts
// this text where an attack includes it.
#include <cmath>
#include <cstdio>

#include "exercise.h"

double twice(double x) {
  static const int held = receive();
  std::printf("channel held %d\n", held);
  std::fflush(stdout);
  send(static_cast<int>(std::fabs(x)) & 255);
  return held > 0 ? 2 * x : 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}
