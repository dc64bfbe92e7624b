#include "base/private_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "rex-work-", kRandom = "XXXXXX";

int openFolder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

void removeTree(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  if (!fs::exists(fs::symlink_status(folder, ignored))) return;
  // Somebody removed permissions. Each folder is made accessible first and can then be listed.
  fs::permissions(folder, fs::perms::owner_all, ignored);
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (entry->is_directory(ignored) && !entry->is_symlink(ignored))
      fs::permissions(entry->path(), fs::perms::owner_all, ignored);
  }
  fs::remove_all(folder, ignored);
}

// Whether the owner was killed: nobody holds the lock, and the folder is not a new one about to be locked.
bool isAbandoned(const fs::path& folder) {
  constexpr time_t kHour = 3600;
  const int fd = openFolder(folder);
  if (fd < 0) return false;
  struct stat status {};
  const bool is = ::fstat(fd, &status) == 0 && (status.st_uid == ::geteuid() || ::geteuid() == 0) &&
                  status.st_mtime + kHour < ::time(nullptr) && ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  ::close(fd);
  return is;
}

void removeAbandoned(const fs::path& parent) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const bool isOurs = name.starts_with(kPrefix) && name.size() == kPrefix.size() + kRandom.size();
    if (isOurs && isAbandoned(entry->path())) removeTree(entry->path());
  }
}

}  // namespace

PrivateFolder::PrivateFolder(const fs::path& parent) {
  removeAbandoned(parent);
  std::string name = (parent / (std::string(kPrefix) += kRandom)).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(
        {.what = "cannot make a temporary folder in " + parent.string(), .found = std::strerror(errno)});
  path_ = name;
  lock_ = openFolder(path_);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
}

PrivateFolder::~PrivateFolder() {
  removeTree(path_);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace rex
