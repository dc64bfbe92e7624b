// Leaves a grandchild behind, in a session of its own, that writes later.
#include <fstream>

#include <unistd.h>

#include "exercise.h"

double twice(double) {
  if (fork() == 0) {
    setsid();
    if (fork() == 0) {
      sleep(200);
      std::ofstream("/tmp/rex-battery-stayed") << "still here\n";
      for (;;) {
      }
    }
    _exit(0);
  }
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}
