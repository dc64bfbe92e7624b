// Waits for the disk in the constructor of a global variable, past the cache, so that it never sleeps, hardly
// uses a core and is never ready, as on a machine that is too busy to start programs.
#include <cstdlib>

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include "exercise.h"

namespace {
const bool ready = [] {
  void* const page = aligned_alloc(4096, 1 << 16);
  for (;;) {
    DIR* const folder = opendir("/usr/bin");
    for (const dirent* entry = readdir(folder); entry != nullptr; entry = readdir(folder)) {
      const int file = openat(dirfd(folder), entry->d_name, O_RDONLY | O_DIRECT | O_CLOEXEC);
      while (file >= 0 && read(file, page, 1 << 16) > 0) {
      }
      close(file);
    }
    closedir(folder);
  }
  return true;
}();
}  // namespace

double twice(double x) { return ready ? 2 * x : 0; }
std::vector<double> squares(int) { return {}; }
int main() {}
