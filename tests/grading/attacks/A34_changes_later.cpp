// A thread that changes what was returned.
#include <thread>

#include "exercise.h"

std::vector<double> result;

double twice(double) { return 0; }
std::vector<double> squares(int) {
  result.assign(4, 0);
  std::thread([] {
    for (;;)
      for (int k = 0; k < 4; ++k) result[k] = k * k + 0.5;
  }).detach();
  return result;
}
int main() {}
