// Makes 70000 sections, so that the numbers of sections stand in a table of their own, and puts the function
// with the forbidden call behind them all.
#include "exercise.h"

asm(R"(
  .macro fill_one
  .section .rodata.fill\@,"a",@progbits
  .byte 0
  .endm
  .rept 70000
  fill_one
  .endr
  .section .text.far,"ax",@progbits
  .type far_away, @function
far_away:
  sub $8, %rsp
  call _ZN3rex6answerEd@PLT
  add $8, %rsp
  ret
  .size far_away, . - far_away
  .text
)");

extern "C" double far_away(double x);

double twice(double x) { return far_away(x); }

std::vector<double> squares(int) { return {}; }
int main() {}
