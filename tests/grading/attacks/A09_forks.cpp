// Starts processes without end.
#include <unistd.h>

#include "exercise.h"

double twice(double) {
  for (;;) fork();
}

std::vector<double> squares(int) {
  for (;;) vfork();
}
int main() {}
