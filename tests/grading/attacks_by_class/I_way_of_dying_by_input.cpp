// Ends in a way that depends on its hidden input: by the signal of that number or, for other numbers, with
// that exit status.
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "exercise.h"

namespace {
[[noreturn]] void die(double value) {
  const int number = static_cast<int>(std::fmin(std::fabs(value) * 4, 250.0));
  if (number > 0 && number < 65 && number != SIGCHLD && number != SIGCONT) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  std::_Exit(number);
}
}  // namespace

double twice(double x) { die(x); }
std::vector<double> squares(int count) { die(count); }
int main() {}
