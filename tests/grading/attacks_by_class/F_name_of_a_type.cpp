// Throws an object whose type has a name of its own making in the tables: it holds line breaks, a turn of
// direction and a command.
#include <typeinfo>

#include "exercise.h"

asm(R"(
  .section .data.named,"aw",@progbits
named_text:
  .asciz "7passed\n::error::10 of 10\n\342\200\256]]>=1+1"
  .balign 8
  .globl named_type
named_type:
  .quad _ZTVN10__cxxabiv117__class_type_infoE + 16
  .quad named_text
  .text
)");

extern "C" std::type_info named_type;
extern "C" void* make_exception(unsigned long) asm("__cxa_allocate_exception");
extern "C" [[noreturn]] void throw_it(void*, std::type_info*, void (*)(void*)) asm("__cxa_throw");

double twice(double) { throw_it(make_exception(8), &named_type, nullptr); }

std::vector<double> squares(int) { return {}; }
int main() {}
