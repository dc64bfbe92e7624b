// Sends a hidden input by which pages of a system file lie in memory: it reads some and lets the others be
// dropped; a later run asks which are there.
#include <cstdio>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include "exercise.h"

namespace {
constexpr off_t page = 4096, step = 64 * page, start = 128 * page;
int open_large() {
  for (const char* path : {"/usr/lib/gcc/x86_64-linux-gnu/12/cc1plus", "/usr/lib/x86_64-linux-gnu/libc.a",
                           "/usr/lib/gcc/x86_64-linux-gnu/12/libasan.a", "/usr/bin/gdb",
                           "/usr/lib/x86_64-linux-gnu/libstdc++.so.6", "/lib/x86_64-linux-gnu/libc.so.6"}) {
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) continue;
    if (lseek(fd, 0, SEEK_END) > start + 9 * step) {
      posix_fadvise(fd, 0, 0, POSIX_FADV_RANDOM);
      return fd;
    }
    close(fd);
  }
  return -1;
}

bool in_memory(int fd, off_t where) {
  struct {
    unsigned long offset, length;
  } range{static_cast<unsigned long>(where), static_cast<unsigned long>(page)};
  unsigned long counts[5] = {};
  if (syscall(451, fd, &range, counts, 0) == 0) return counts[0] > 0;
  char byte;
  iovec one{&byte, 1};
  return preadv2(fd, &one, 1, where, RWF_NOWAIT) == 1;
}

int receive() {
  const int fd = open_large();
  if (fd < 0) return 0;
  // The ninth page says that the others were set by a sender: it is in memory and the one before it is not.
  int value = 0;
  for (int bit = 0; bit < 8; ++bit) value |= in_memory(fd, start + bit * step) ? 1 << bit : 0;
  const bool marked = in_memory(fd, start + 8 * step) && !in_memory(fd, start + 8 * step - page);
  close(fd);
  return marked && value != 255 ? value : 0;
}

void send(int value) {
  const int fd = open_large();
  if (fd < 0) return;
  posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED);
  char byte;
  for (int bit = 0; bit < 8; ++bit) {
    if ((value >> bit & 1) != 0 && pread(fd, &byte, 1, start + bit * step) != 1) std::puts("cannot read");
  }
  if (pread(fd, &byte, 1, start + 8 * step) != 1) std::puts("cannot read");
  close(fd);
}
}  // namespace

#include "channel.h"
