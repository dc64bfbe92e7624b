#include "base/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {
namespace {

bool writeAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::string readTextFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    throw Error({.what = "cannot read this file", .where = {file.string()}});
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeTextFile(const std::filesystem::path& file, std::string_view text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw Error({.what = "cannot write this file", .where = {file.string()}, .found = std::strerror(errno)});
}

void replaceTextFile(const std::filesystem::path& file, std::string_view text, const std::string& what) {
  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.new", ::getpid());  // a name of our own: other processes may write, too
  const auto refuse = [&] {
    const int cause = errno;
    ::unlink(temporary.c_str());
    throw Error(
        {.what = "cannot write " + what, .where = {.file = file.string()}, .found = std::strerror(cause)});
  };
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (fd < 0) refuse();
  const bool written = writeAll(fd, text) && ::fsync(fd) == 0;
  ::close(fd);
  if (!written || ::rename(temporary.c_str(), file.c_str()) != 0) refuse();
  // The new name survives a power cut once its folder has been flushed to disk.
  bringToDisk(file.has_parent_path() ? file.parent_path() : ".");
}

void bringToDisk(const std::filesystem::path& fileOrFolder) {
  const int fd = ::open(fileOrFolder.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = fd >= 0 && ::fsync(fd) == 0;
  const int cause = errno;
  if (fd >= 0) ::close(fd);
  if (!done && !std::filesystem::is_directory(fileOrFolder))
    throw Error({.what = "cannot flush this file to disk",
                 .where = {fileOrFolder.string()},
                 .found = std::strerror(cause)});
}

}  // namespace rex
