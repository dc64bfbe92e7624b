// More than there is.
#include "exercise.h"

double twice(double) { return 0; }
std::vector<double> squares(int) {
  std::vector<double> result(1);
  for (;;) result.resize(result.size() * 1024);
}
int main() {}
