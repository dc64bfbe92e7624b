// Computes for ever and ignores the warnings.
#include <csignal>

#include "exercise.h"

double twice(double x) {
  std::signal(SIGXCPU, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  for (volatile double y = x;; y = y + 1) {
  }
}
std::vector<double> squares(int) { return {}; }
int main() {}
