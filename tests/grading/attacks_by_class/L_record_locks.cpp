// Sends a hidden input to a neighbour by locks on single bytes of a system file, and reads the locks a
// neighbour holds.
#include <cstdio>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "exercise.h"

namespace {
const char* const paths[] = {"/etc/passwd", "/etc/ld.so.cache", "/lib/x86_64-linux-gnu/libc.so.6",
                             "/proc/self/exe", "/dev/null"};

int receive() {
  int value = 0;
  for (const char* path : paths) {
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) continue;
    for (int bit = 0; bit < 8; ++bit) {
      for (int kind : {F_GETLK, F_OFD_GETLK}) {
        struct flock lock {};
        lock.l_type = F_WRLCK, lock.l_whence = SEEK_SET, lock.l_start = bit, lock.l_len = 1;
        if (fcntl(fd, kind, &lock) == 0 && lock.l_type != F_UNLCK) value |= 1 << bit;
      }
    }
    if (flock(fd, LOCK_EX | LOCK_NB) != 0 && value == 0) value = 256;
    flock(fd, LOCK_UN);
    close(fd);
  }
  return value == 256 ? 0 : value;
}

void send(int value) {
  for (const char* path : paths) {
    const int fd = open(path, O_RDONLY);
    if (fd < 0) continue;
    int held = 0;
    for (int bit = 0; bit < 8; ++bit) {
      if ((value >> bit & 1) == 0) continue;
      struct flock lock {};
      lock.l_type = F_RDLCK, lock.l_whence = SEEK_SET, lock.l_start = bit, lock.l_len = 1;
      if (fcntl(fd, F_OFD_SETLK, &lock) == 0 || fcntl(fd, F_SETLK, &lock) == 0) ++held;
    }
    if (fcntl(fd, F_SETLEASE, F_RDLCK) == 0) ++held;
    if (held > 0) std::printf("%s: %d locks or leases\n", path, held);
  }
  usleep(300000);
}
}  // namespace

#include "channel.h"
