// Lets messages of the compiler carry hidden signs and commands: in a deprecation text, in #warning, in a
// failed promise about file names set by #line.
#include "exercise.h"

#warning "‮::error::turned round‬ ​ passed 10 of 10"
#pragma message("\033[2J\033[H\n::error file=x::cleared the screen\n=HYPERLINK(1)")

[[deprecated("\n::error::passed\n\033[32mpassed\033[0m \u202e01 fo 01")]] int old();

#line 1 "\n::error::in the name of a file\n\033[1A\033[2K"
int unused_result() { return old(); }
#line 3 "=cmd|' /C calc'!A0"
int other_result() { return old(); }
#line 5 "‮pass.h"
int third_result() { return old(); }
#line 20 "main.cpp"

int passаgeㅤ = 1;

double twice(double) { return 0; }

std::vector<double> squares(int) { return {}; }
int main() {}
