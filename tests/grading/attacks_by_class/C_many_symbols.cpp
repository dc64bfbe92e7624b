// Makes an object with 400000 symbols with long names and as many relocations, of which none does anything.
#include "exercise.h"

asm(R"(
  .macro name_one
  .globl a_symbol_with_a_rather_long_name_so_that_the_table_grows_\@
a_symbol_with_a_rather_long_name_so_that_the_table_grows_\@ :
  .quad a_symbol_with_a_rather_long_name_so_that_the_table_grows_\@
  .endm
  .data
  .rept 400000
  name_one
  .endr
  .text
)");

double twice(double x) { return 2 * x; }

std::vector<double> squares(int) { return {}; }
int main() {}
