#include "grading/result_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "grading/text_file.h"

namespace rex::grading {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Error({.what = "cannot write the result file",
               .where = {.file = file.string()},
               .found = std::strerror(errno)});
}

bool writeAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

GradeResult loadResult(const std::filesystem::path& file) {
  return gradeResultFromJson(readTextFile(file), file.string());
}

void saveResult(const GradeResult& result, const std::filesystem::path& file) {
  const std::string text = toJson(result);
  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.new", ::getpid());  // of our own: another grading may write beside us
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (fd < 0) refuse(file);
  const bool written = writeAll(fd, text) && ::fsync(fd) == 0;
  ::close(fd);
  if (!written || ::rename(temporary.c_str(), file.c_str()) != 0) refuse(file);
}

}  // namespace rex::grading
