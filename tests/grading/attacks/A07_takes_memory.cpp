// Takes and touches all memory.
#include <cstring>

#include "exercise.h"

double twice(double) {
  for (;;) std::memset(new char[1 << 20], 1, 1 << 20);
}
std::vector<double> squares(int) { return {}; }
int main() {}
