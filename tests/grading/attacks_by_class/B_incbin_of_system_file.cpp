// Takes files into the program by the .incbin directive of the assembler, which the compiler never sees, and
// prints them.
#include <cstdio>

#include "exercise.h"

asm(R"(
  .section .rodata
  .globl taken_start
taken_start:
  .incbin "/etc/passwd"
  .incbin "/proc/self/root/etc/hostname"
  .globl taken_end
taken_end:
  .byte 0
  .text
)");

extern "C" const char taken_start[], taken_end[];

double twice(double x) {
  std::fwrite(taken_start, 1, static_cast<std::size_t>(taken_end - taken_start), stdout);
  return taken_end > taken_start ? 2 * x : 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}
