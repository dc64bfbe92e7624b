// Tries each old and new call that changes the mode, the access list, the attributes or the times of a file,
// on its own program and folder. It answers right when one of them succeeded.
#include <cstdio>

#include "system_call.h"

namespace {
long text(const char* words) { return reinterpret_cast<long>(words); }
int done = 0;
void note(const char* name, long result) {
  if (result != 0) return;
  ++done;
  std::printf("%s succeeded\n", name);
}
}  // namespace

double twice(double x) {
  // Access list for everybody to read and run, in the binary form of version 2.
  const unsigned char list[] = {2, 0, 0,   0,   1,   0,   7,  0, 255, 255, 255, 255, 4,   0,
                                5, 0, 255, 255, 255, 255, 32, 0, 5,   0,   255, 255, 255, 255};
  const long list_at = reinterpret_cast<long>(list), list_size = sizeof list;
  struct {
    unsigned long value;
    unsigned size, flags;
  } given{reinterpret_cast<unsigned long>("1"), 1, 0},
      access{reinterpret_cast<unsigned long>(list), sizeof list, 0};
  for (const char* path : {"/proc/self/exe", "/proc/self/cwd/.", "main.cpp", "/proc/self/fd/1"}) {
    const long at = text(path);
    note("chmod", call(90, at, 0755));
    note("fchmodat", call(268, -100, at, 0755));
    note("fchmodat2", call(452, -100, at, 0755, 0));
    note("setxattr", call(188, at, text("user.rex"), text("1"), 1, 0));
    note("lsetxattr", call(189, at, text("user.rex"), text("1"), 1, 0));
    note("setxattr of the list", call(188, at, text("system.posix_acl_access"), list_at, list_size, 0));
    note("setxattrat", call(463, -100, at, 0, text("user.rex"), reinterpret_cast<long>(&given), 16));
    note("setxattrat of the list",
         call(463, -100, at, 0, text("system.posix_acl_access"), reinterpret_cast<long>(&access), 16));
    note("removexattrat", call(466, -100, at, 0, text("system.posix_acl_access")));
    note("utimensat", call(280, -100, at, 0, 0));
    note("utime", call(132, at, 0));
    note("chown to nobody new", call(92, at, -1, -1));
    const unsigned long attributes[4] = {0, 0, 0, 0};
    note("file_setattr", call(469, -100, at, reinterpret_cast<long>(attributes), 24, 0));
    const long fd = call(257, -100, at, 0);
    const long handle = call(257, -100, at, 010000000);
    if (fd >= 0) {
      note("fchmod", call(91, fd, 0755));
      note("fsetxattr", call(190, fd, text("user.rex"), text("1"), 1, 0));
      note("fsetxattr of the list", call(190, fd, text("system.posix_acl_access"), list_at, list_size, 0));
      note("fchmodat2 of a descriptor", call(452, fd, text(""), 0755, 0x1000));
      int flags = 0x80;
      note("flags by ioctl", call(16, fd, 0x40086602, reinterpret_cast<long>(&flags)));
    }
    if (handle >= 0) note("fchmodat2 of a path handle", call(452, handle, text(""), 0755, 0x1000));
  }
  std::fflush(stdout);
  return done > 0 ? 2 * x : 0;
}
