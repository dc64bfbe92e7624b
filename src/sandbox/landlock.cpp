#include "sandbox/landlock.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

// The headers of the machine may be older than its kernel: names and values of linux/landlock.h.
struct RulesetAttributes {
  std::uint64_t files = 0;
  std::uint64_t network = 0;  // since version 4
  std::uint64_t scoped = 0;   // since version 6
};
constexpr std::uint64_t kExecute = 1u << 0, kWriteFile = 1u << 1, kReadFile = 1u << 2, kReadFolder = 1u << 3;
constexpr std::uint64_t kAllOfVersion1 = (1u << 13) - 1, kMoveFile = 1u << 13, kTruncate = 1u << 14,
                        kDeviceControl = 1u << 15;
constexpr std::uint64_t kBindAndConnect = 3, kAbstractSocketsAndSignals = 3;
constexpr std::uint64_t kForFiles = kExecute | kWriteFile | kReadFile | kTruncate | kDeviceControl;

std::uint64_t allAccess(int version) {
  return kAllOfVersion1 | (version >= 2 ? kMoveFile : 0) | (version >= 3 ? kTruncate : 0) |
         (version >= 5 ? kDeviceControl : 0);
}

}  // namespace

int landlockVersion() {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return version > 0 ? static_cast<int>(version) : 0;
}

FileRules::FileRules() : version_(landlockVersion()) {
  RulesetAttributes attributes{.files = allAccess(version_)};
  if (version_ >= 4) attributes.network = kBindAndConnect;
  if (version_ >= 6) attributes.scoped = kAbstractSocketsAndSignals;
  const std::size_t size = version_ >= 6 ? 24 : version_ >= 4 ? 16 : 8;
  if (version_ > 0) fd_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes, size, 0));
  if (fd_ < 0) throw Error({.what = "this kernel offers no landlock", .found = std::strerror(errno)});
}

FileRules::~FileRules() { ::close(fd_); }

void FileRules::allow(const std::filesystem::path& path, unsigned long long access) {
  const int file = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (file < 0) return;
  struct stat status {};
  ::fstat(file, &status);
  if (!S_ISDIR(status.st_mode)) access &= kForFiles;
  const landlock_path_beneath_attr rule{.allowed_access = access & allAccess(version_), .parent_fd = file};
  const long added = ::syscall(SYS_landlock_add_rule, fd_, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  ::close(file);
  if (added != 0) throw Error({.what = "cannot allow a file in the sandbox", .found = std::strerror(errno)});
}

void FileRules::allowReading(const std::filesystem::path& path) {
  allow(path, kExecute | kReadFile | kReadFolder);
}

void FileRules::allowWriting(const std::filesystem::path& path) { allow(path, ~0ull); }

void FileRules::enforce() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (::syscall(SYS_landlock_restrict_self, fd_, 0) != 0)
    throw Error({.what = "cannot enforce landlock", .found = std::strerror(errno)});
}

}  // namespace rex::sandbox
