// Prints 10 GB: to standard output, to standard error, without an end of line.
#include <cstdio>
#include <string>

#include "exercise.h"

double twice(double) {
  const std::string line(1 << 16, 'x');
  for (int k = 0; k < 163840; ++k) std::puts(line.c_str());
  return 0;
}

std::vector<double> squares(int) {
  const std::string text(1 << 16, 'x');
  for (int k = 0; k < 163840; ++k) std::fputs(text.c_str(), stderr);
  return {};
}
int main() {}
