// Lets the assembler repeat an empty step ten to the fifteenth times; the compiler itself is done at once.
#include "exercise.h"

asm(R"(
  .rept 100000
  .rept 100000
  .rept 100000
  .set count, 1
  .endr
  .endr
  .endr
)");

double twice(double x) { return 2 * x; }

std::vector<double> squares(int) { return {}; }
int main() {}
