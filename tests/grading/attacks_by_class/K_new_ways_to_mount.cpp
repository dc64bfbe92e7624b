// Makes a namespace of its own and attaches a file system by the newer calls for mounting, which are not
// mount itself.
#include <cstdio>

#include "system_call.h"

namespace {
long text(const char* words) { return reinterpret_cast<long>(words); }
int done = 0;
long note(const char* name, long result) {
  std::printf("%s gave %ld\n", name, result);
  if (result >= 0) ++done;
  return result;
}
}  // namespace

double twice(double x) {
  // Nothing is attached outside a namespace of its own.
  const bool own = note("unshare", call(272, 0x10000000 | 0x00020000)) == 0;
  const long system = note("fsopen", call(430, text("tmpfs"), 0));
  if (system >= 0) {
    call(431, system, 6, 0, 0, 0);
    const long mount = note("fsmount", call(432, system, 0, 0));
    if (mount >= 0 && own) note("move_mount", call(429, mount, text(""), -100, text("/tmp"), 4));
  }
  note("open_tree", call(428, -100, text("/"), 1 | 0x8000));
  note("statmount", call(457, 0, 0, 0, 0) == -38 ? -38 : -1);
  note("listns", call(470, 0, 0, 0, 0) == -38 ? -38 : -1);
  note("open_by_handle_at", call(304, -100, text("\0\0\0\0"), 0));
  std::fflush(stdout);
  return done > 0 ? 2 * x : 0;
}
