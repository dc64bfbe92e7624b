// A directive whose number and file are macros.
#include "exercise.h"
#define WHERE 7 "vector"
#line WHERE
double twice(double) {
  int unused;
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}
