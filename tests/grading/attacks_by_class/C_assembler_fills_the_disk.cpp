// Lets the assembler write an object of 6 GiB with one line of data.
#include "exercise.h"

asm(R"(
  .data
  .zero 0x180000000
  .byte 1
  .text
)");

double twice(double x) { return 2 * x; }

std::vector<double> squares(int) { return {}; }
int main() {}
