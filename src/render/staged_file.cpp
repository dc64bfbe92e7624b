#include <cerrno>
#include <cstring>
#include <fstream>

#include <unistd.h>

#include "base/error.h"
#include "render/staged_file_internal.h"

namespace rex::internal {

void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path part = path;
  part += ".part-" + std::to_string(::getpid());
  const auto fail = [&](const std::string& cause) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error({.what = "cannot write '" + path.string() + "'", .found = cause});
  };
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) fail(error.message());
}

}  // namespace rex::internal
