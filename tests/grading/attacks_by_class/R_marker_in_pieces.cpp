// A directive in two lines that names another file and line, so that messages point elsewhere.
#include "exercise.h"
#li\
ne 900 "exercise.h"
double twice(double) {
  int unused;
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}
