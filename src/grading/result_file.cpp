#include "grading/result_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::grading {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::filesystem::path& file) {
  throw Error({.what = what, .where = {.file = file.string()}, .found = std::strerror(errno)});
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
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("cannot read the result file", file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return gradeResultFromJson(text, file.string());
}

void saveResult(const GradeResult& result, const std::filesystem::path& file) {
  const std::string text = toJson(result);
  std::filesystem::path temporary = file;
  temporary += ".new";
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (fd < 0) refuse("cannot write the result file", temporary);
  const bool written = writeAll(fd, text) && ::fsync(fd) == 0;
  ::close(fd);
  if (!written || ::rename(temporary.c_str(), file.c_str()) != 0)
    refuse("cannot write the result file", file);
}

}  // namespace rex::grading
