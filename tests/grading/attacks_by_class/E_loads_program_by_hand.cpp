// Does by hand what execve does: maps the dynamic loader, builds arguments and a stack for it and jumps to
// its start, to run echo in the place of the worker. No call to execve is made.
#include "system_call.h"

namespace {
struct Segment {
  unsigned type, flags;
  unsigned long offset, address, physical, in_file, in_memory, align;
};
struct Header {
  unsigned char magic[16];
  unsigned short type, machine;
  unsigned version;
  unsigned long entry, segments, sections;
  unsigned flags;
  unsigned short size, segment_size, segment_count, section_size, section_count, names;
};

alignas(4096) char file[1 << 20];
alignas(16) unsigned long stack[1 << 15];
}  // namespace

double twice(double) {
  const long fd = call(257, -100, reinterpret_cast<long>("/lib64/ld-linux-x86-64.so.2"), 0);
  if (fd < 0) return 0;
  long size = 0;
  for (long got;
       (got = call(0, fd, reinterpret_cast<long>(file + size), static_cast<long>(sizeof file) - size)) > 0;)
    size += got;
  auto* header = reinterpret_cast<Header*>(file);
  auto* segment = reinterpret_cast<Segment*>(file + header->segments);
  const long base = call(9, 0, 1 << 20, 7, 0x22, -1, 0);
  long where = base;
  if (base < 0 && base > -4096) {
    where = call(9, 0, 1 << 20, 3, 0x22, -1, 0);
    if (where < 0 && where > -4096) return 0;
  }
  for (int i = 0; i < header->segment_count; ++i) {
    if (segment[i].type != 1) continue;
    auto* target = reinterpret_cast<char*>(where + static_cast<long>(segment[i].address));
    for (unsigned long k = 0; k < segment[i].in_file; ++k) target[k] = file[segment[i].offset + k];
  }
  for (int i = 0; i < header->segment_count; ++i) {
    if (segment[i].type != 1 || where == base) continue;
    const long start = (where + static_cast<long>(segment[i].address)) & ~4095L;
    const long end = where + static_cast<long>(segment[i].address + segment[i].in_memory);
    call(10, start, (end - start + 4095) & ~4095L,
         ((segment[i].flags & 1) != 0 ? 4 : 0) | ((segment[i].flags & 2) != 0 ? 2 : 0) | 1);
  }
  unsigned long* top = stack + (1 << 14);
  unsigned long* s = top;
  *s++ = 3;
  *s++ = reinterpret_cast<unsigned long>("ld.so");
  *s++ = reinterpret_cast<unsigned long>("/bin/echo");
  *s++ = reinterpret_cast<unsigned long>("another program runs in the place of the worker");
  *s++ = 0;
  *s++ = 0;
  const unsigned long pairs[] = {3,  static_cast<unsigned long>(where) + header->segments,
                                 4,  56,
                                 5,  header->segment_count,
                                 6,  4096,
                                 7,  0,
                                 9,  static_cast<unsigned long>(where) + header->entry,
                                 11, 0,
                                 12, 0,
                                 13, 0,
                                 14, 0,
                                 23, 0,
                                 25, reinterpret_cast<unsigned long>(file),
                                 0,  0};
  for (unsigned long value : pairs) *s++ = value;
  asm volatile("mov %0, %%rsp\n xor %%edx, %%edx\n xor %%ebp, %%ebp\n jmp *%1" ::"r"(top),
               "r"(static_cast<unsigned long>(where) + header->entry)
               : "memory");
  __builtin_unreachable();
}
