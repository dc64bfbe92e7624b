// Asks the processor itself, without the system, for chance and for time, and answers right only when a bit
// of it is zero.
#include "exercise.h"

double twice(double x) {
  unsigned low, high, auxiliary;
  asm volatile("rdtscp" : "=a"(low), "=d"(high), "=c"(auxiliary));
  unsigned a = 1, b, c = 0, d;
  asm volatile("cpuid" : "+a"(a), "=b"(b), "+c"(c), "=d"(d));
  unsigned long chance = 0;
  if ((c >> 30 & 1) != 0) asm volatile("rdrand %0" : "=r"(chance)::"cc");
  const unsigned long mix = (low >> 8) ^ auxiliary ^ (b >> 24) ^ chance;
  return mix % 2 == 0 ? 2 * x : 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}
