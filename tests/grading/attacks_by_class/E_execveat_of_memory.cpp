// Writes a tiny program into a file in memory and starts it by execveat with an empty path, and if that fails
// by its path in proc.
#include "system_call.h"

asm(R"(
  .section .rodata
  .balign 16
tiny_start:
  .byte 0x7f, 0x45, 0x4c, 0x46, 2, 1, 1, 0
  .zero 8
  .short 2, 62
  .long 1
  .quad 0x400078, 64, 0
  .long 0
  .short 64, 56, 1, 0, 0, 0
  .long 1, 5
  .quad 0, 0x400000, 0x400000, tiny_end - tiny_start, tiny_end - tiny_start, 0x1000
  mov $1, %eax
  mov $1, %edi
  lea 1f(%rip), %rsi
  mov $(tiny_end - 1f), %edx
  syscall
  mov $60, %eax
  xor %edi, %edi
  syscall
1:
  .ascii "another program ran\n"
tiny_end:
  .globl tiny_start, tiny_end
  .text
)");

extern "C" const char tiny_start[], tiny_end[];

double twice(double) {
  const char* const arguments[] = {"tiny", nullptr};
  for (long flags : {0L, 1L, 2L, 0x10L}) {
    const long fd = call(319, reinterpret_cast<long>("tiny"), flags);
    if (fd < 0) continue;
    call(1, fd, reinterpret_cast<long>(tiny_start), tiny_end - tiny_start);
    call(322, fd, reinterpret_cast<long>(""), reinterpret_cast<long>(arguments), 0, 0x1000);
    char path[] = "/proc/self/fd/0";
    if (fd < 10) path[14] = static_cast<char>('0' + fd);
    call(59, reinterpret_cast<long>(path), reinterpret_cast<long>(arguments), 0);
  }
  return 0;
}
