// Reads large files of the system through pages that it drops at once, so that the kernel waits for it with
// page faults before it is ready.
#include <dirent.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "exercise.h"

namespace {
const bool ready = [] {
  constexpr std::size_t kSize = 1 << 20;
  volatile char sum = 0;
  for (;;) {
    DIR* const folder = opendir("/usr/lib/x86_64-linux-gnu");
    for (const dirent* entry = readdir(folder); entry != nullptr; entry = readdir(folder)) {
      const int file = openat(dirfd(folder), entry->d_name, O_RDONLY | O_CLOEXEC);
      const off_t size = lseek(file, 0, SEEK_END);
      void* const pages = mmap(nullptr, kSize, PROT_READ, MAP_PRIVATE, file, 0);
      if (pages != MAP_FAILED && size >= static_cast<off_t>(kSize)) {
        for (std::size_t k = 0; k < kSize; k += 4096) sum = sum + static_cast<const char*>(pages)[k];
        madvise(pages, kSize, MADV_DONTNEED);
        posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
        munmap(pages, kSize);
      }
      close(file);
    }
    closedir(folder);
  }
  return true;
}();
}  // namespace

double twice(double x) { return ready ? 0 * x : 1; }
std::vector<double> squares(int) { return {}; }
int main() {}
