#include "sandbox/user_slot.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

// User IDs that neither Debian nor systemd assigns: 60706 to 61183.
constexpr unsigned kFirst = 60706;
constexpr int kSlots = 256;
constexpr const char* kFolder = "/run/rex-slots";

}  // namespace

UserSlot::UserSlot() {
  if (::geteuid() != 0) return;
  const bool made = ::mkdir(kFolder, 0700) == 0 || errno == EEXIST;
  for (int slot = 0; made && slot < kSlots; ++slot) {
    const std::string file = fmt::format("{}/{}", kFolder, slot);
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (lock_ < 0) break;
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) {
      user_ = kFirst + static_cast<unsigned>(slot);
      return;
    }
    ::close(lock_);
  }
  throw Error(
      {.what = fmt::format("no free user ID for the sandbox in {}", kFolder), .found = std::strerror(errno)});
}

UserSlot::~UserSlot() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace rex::sandbox
