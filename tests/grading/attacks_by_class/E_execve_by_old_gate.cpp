// Asks for execve by the gate for programs of 32 bits and by the numbers of the x32 interface, which a filter
// for the usual calls may not know.
#include <cstring>

#include "system_call.h"

namespace {
long old_gate(long number, unsigned long a, unsigned long b, unsigned long c) {
  long result;
  asm volatile("int $0x80"
               : "=a"(result)
               : "a"(number), "b"(a), "c"(b), "d"(c)
               : "memory", "r8", "r9", "r10", "r11");
  return result;
}
}  // namespace

double twice(double) {
  // Addresses below 4 GiB, for the old gate.
  const long low = call(9, 0x10000000, 4096, 3, 0x32, -1, 0);
  if (low == 0x10000000) {
    auto* page = reinterpret_cast<char*>(low);
    std::strcpy(page, "/bin/echo");
    std::strcpy(page + 64, "another program ran");
    auto* arguments = reinterpret_cast<unsigned*>(page + 128);
    arguments[0] = 0x10000000;
    arguments[1] = 0x10000040;
    arguments[2] = 0;
    old_gate(11, 0x10000000, 0x10000080, 0);
    old_gate(358, 0xffffff9c, 0x10000000, 0x10000080);
  }
  const char* const arguments[] = {"echo", "another program ran", nullptr};
  call(0x40000000 + 520, reinterpret_cast<long>("/bin/echo"), reinterpret_cast<long>(arguments), 0);
  call(0x40000000 + 59, reinterpret_cast<long>("/bin/echo"), reinterpret_cast<long>(arguments), 0);
  return 0;
}
