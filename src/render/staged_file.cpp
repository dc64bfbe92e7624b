#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

#include "base/error.h"
#include "render/staged_file_internal.h"

namespace rex::internal {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& cause) {
  throw Error({.what = "cannot write '" + path.string() + "'", .found = cause});
}

}  // namespace

StagedFile::StagedFile(const std::filesystem::path& path) : path_(path) {
  std::error_code problem;
  target_ = std::filesystem::absolute(path, problem);
  if (problem) fail(path_, problem.message());
  part_ = target_;
  part_ += ".part-" + std::to_string(::getpid());
  if (!std::ofstream(part_, std::ios::binary)) fail(path_, std::strerror(errno));
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void StagedFile::commit() {
  std::error_code problem;
  std::filesystem::rename(part_, target_, problem);
  if (problem) fail(path_, problem.message());
}

void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  StagedFile staged(path);
  std::ofstream file(staged.part(), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(path, std::strerror(errno));
  staged.commit();
}

}  // namespace rex::internal
