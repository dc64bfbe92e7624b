#include "grading/to_disk.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::grading {

void bringToDisk(const std::filesystem::path& fileOrFolder) {
  const int fd = ::open(fileOrFolder.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = fd >= 0 && ::fsync(fd) == 0;
  const int cause = errno;
  if (fd >= 0) ::close(fd);
  if (!done && !std::filesystem::is_directory(fileOrFolder))
    throw Error({.what = "cannot bring this file to the disk",
                 .where = {fileOrFolder.string()},
                 .found = std::strerror(cause)});
}

}  // namespace rex::grading
