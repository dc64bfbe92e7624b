#include "base/opened_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

Error unreadableFolder(const std::filesystem::path& path, int cause) {
  return Error({.what = "cannot read this folder",
                .where = {path.string()},
                .found = cause == ELOOP || cause == ENOTDIR ? "no folder" : std::strerror(cause)});
}

std::filesystem::file_type typeOfMode(mode_t mode) {
  using std::filesystem::file_type;
  if (S_ISREG(mode)) return file_type::regular;
  if (S_ISDIR(mode)) return file_type::directory;
  if (S_ISLNK(mode)) return file_type::symlink;
  return file_type::unknown;
}

}  // namespace

OpenedFile::OpenedFile(OpenedFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

OpenedFile::~OpenedFile() {
  if (fd_ >= 0) ::close(fd_);
}

std::int64_t OpenedFile::modifiedAt() const {
  struct stat status {};
  return ::fstat(fd_, &status) == 0 ? status.st_mtim.tv_sec : 0;
}

std::size_t OpenedFile::size() const {
  struct stat status {};
  return ::fstat(fd_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

OpenedFolder::OpenedFolder(const std::filesystem::path& path)
    : file_(::open(path.c_str(), kFolder)), path_(path) {
  if (file_.fd() < 0) throw unreadableFolder(path, errno);
}

OpenedFolder::OpenedFolder(OpenedFile file, std::filesystem::path path)
    : file_(std::move(file)), path_(std::move(path)) {}

// Uses a new descriptor each time, as closing the list closes it. This also makes each list start at the
// first entry.
std::vector<OpenedFolder::Entry> OpenedFolder::entries() const {
  const int fd = ::openat(file_.fd(), ".", kFolder);
  if (fd < 0) throw unreadableFolder(path_, errno);
  const std::unique_ptr<DIR, int (*)(DIR*)> list(::fdopendir(fd), ::closedir);
  std::vector<Entry> found;
  errno = 0;
  for (const dirent* entry = ::readdir(list.get()); entry != nullptr; entry = ::readdir(list.get())) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") found.push_back({name, typeOf(name)});
    errno = 0;
  }
  if (errno != 0) throw unreadableFolder(path_, errno);
  std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return found;
}

std::filesystem::file_type OpenedFolder::typeOf(const std::string& name) const {
  struct stat status {};
  if (::fstatat(file_.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return std::filesystem::file_type::not_found;
  return typeOfMode(status.st_mode);
}

OpenedFolder OpenedFolder::folder(const std::string& name) const {
  OpenedFile inner(::openat(file_.fd(), name.c_str(), kFolder | O_NOFOLLOW));
  if (inner.fd() < 0) throw unreadableFolder(path_ / name, errno);
  return {std::move(inner), path_ / name};
}

OpenedFile OpenedFolder::file(const std::string& name) const {
  OpenedFile opened(
      ::openat(file_.fd(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (opened.fd() < 0)
    throw Error({.what = "cannot be read",
                 .where = {(path_ / name).string()},
                 .found = errno == ELOOP    ? "a symbolic link"
                          : errno == ENOENT ? "no file"
                                            : std::strerror(errno)});
  return opened;
}

}  // namespace rex
