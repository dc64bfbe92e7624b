// Takes memory and prints blanks in proportion to its hidden input, so that reported sizes of memory and of
// cut text tell it.
#include <cmath>
#include <cstdio>
#include <cstring>

#include "exercise.h"

namespace {
void take(double amount) {
  const auto units = static_cast<std::size_t>(std::fmin(std::fabs(amount) * 8, 512.0));
  std::vector<char> memory(units << 18);
  if (!memory.empty()) std::memset(memory.data(), 1, memory.size());
  for (std::size_t i = 0; i < units * 1000; ++i) std::putchar(' ');
  std::fflush(stdout);
}
}  // namespace

double twice(double x) {
  take(x);
  return 2 * x;
}

std::vector<double> squares(int count) {
  take(count);
  return {};
}

int main() {}
