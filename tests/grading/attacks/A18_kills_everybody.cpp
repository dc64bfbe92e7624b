// Kills all processes, stops its parent, ends its group.
#include <csignal>

#include <unistd.h>

#include "exercise.h"

double twice(double) {
  kill(-1, SIGKILL);
  kill(getppid(), SIGSTOP);
  kill(0, SIGTERM);
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}
