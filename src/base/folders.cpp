#include "base/folders.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "base/error.h"
#include "base/text.h"

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

namespace {

namespace fs = std::filesystem;

// Without links, as a program may be started through one. In the folder of a killed build, whose libraries
// are gone, the path stays as it is.
fs::path withoutLinks(const fs::path& path) {
  std::error_code missing;
  const fs::path real = fs::weakly_canonical(path, missing);
  return missing ? path : real;
}

fs::path folderOfThisLibrary() {
  Dl_info place{};
  const int known = ::dladdr(reinterpret_cast<const void*>(&folderOfThisLibrary), &place);
  assert(known != 0 && place.dli_fname != nullptr);  // this function is in a library or program
  static_cast<void>(known);
  return withoutLinks(place.dli_fname).parent_path();
}

}  // namespace

const fs::path& ownFolder() {
  static const fs::path folder = folderOfThisLibrary().parent_path();
  return folder;
}

const fs::path& homeFolder() {
  static const fs::path folder = withoutLinks(ownFolder() / "home");
  return folder;
}

bool isInstalled() { return !fs::exists(ownFolder() / "build.ninja"); }

bool isOwnFile(const fs::path& path) { return isBelow(ownFolder(), path) || isBelow(homeFolder(), path); }

namespace {

namespace fs = std::filesystem;

// The process of NAME.PID.new; 0 for other names.
pid_t writerOf(const std::string& name) {
  constexpr std::string_view kEnding = ".new";
  if (!name.ends_with(kEnding)) return 0;
  const std::string whole = name.substr(0, name.size() - kEnding.size());
  const std::size_t dot = whole.rfind('.');
  if (dot == whole.npos || dot == 0) return 0;
  return std::max(0, parseNumber<pid_t>(whole.substr(dot + 1)).value_or(0));
}

bool hasEnded(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

void removeLeftovers(const fs::path& folder, int depth) {
  std::vector<fs::path> leftovers;
  std::error_code missing;
  for (fs::recursive_directory_iterator entry(folder, missing), end; !missing && entry != end;
       entry.increment(missing)) {
    if (entry.depth() >= depth) entry.disable_recursion_pending();
    const pid_t writer = writerOf(entry->path().filename().string());
    if (writer > 0 && entry->symlink_status().type() == fs::file_type::regular && hasEnded(writer))
      leftovers.push_back(entry->path());
  }
  for (const fs::path& file : leftovers) fs::remove(file, missing);
}

}  // namespace rex
