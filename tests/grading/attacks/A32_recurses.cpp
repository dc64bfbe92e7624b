// Recursion without end, and a handler that goes on behind the crash.
#include <csetjmp>
#include <csignal>

#include <stdlib.h>

#include "exercise.h"

double deeper(double x) { return x > 1e300 ? 0 : 1 + deeper(x + 1) * 2; }

double twice(double x) { return deeper(x) > 0 ? 0 : 1; }

sigjmp_buf place;

std::vector<double> squares(int) {
  stack_t stack{};
  stack.ss_size = 1 << 16;
  stack.ss_sp = malloc(stack.ss_size);
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_flags = SA_ONSTACK;
  action.sa_handler = [](int) { siglongjmp(place, 1); };
  sigaction(SIGSEGV, &action, nullptr);
  sigsetjmp(place, 1);
  for (;;) *static_cast<volatile int*>(nullptr) = 1;
}
int main() {}
