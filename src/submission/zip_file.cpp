#include "submission/zip_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <minizip/zip.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::grading {
namespace {

// The earliest time that a zip file can store, and permissions to write for the owner and to read for all.
zip_fileinfo plainFile() {
  zip_fileinfo info{};
  info.tmz_date.tm_year = 1980;
  info.tmz_date.tm_mday = 1;
  info.external_fa = 0100644u << 16;
  return info;
}

bool add(zipFile zip, const ZipEntry& entry) {
  const zip_fileinfo info = plainFile();
  // From Unix, so that the permissions count.
  constexpr uLong kMadeByUnix = 3 << 8;
  if (zipOpenNewFileInZip4(zip, entry.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                           Z_DEFAULT_COMPRESSION, 0, -MAX_WBITS, DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY, nullptr,
                           0, kMadeByUnix, 0) != ZIP_OK)
    return false;
  const bool written =
      zipWriteInFileInZip(zip, entry.text.data(), static_cast<unsigned>(entry.text.size())) == ZIP_OK;
  return zipCloseFileInZip(zip) == ZIP_OK && written;
}

bool writeAll(const std::filesystem::path& file, const std::vector<ZipEntry>& entries) {
  const zipFile zip = zipOpen64(file.c_str(), APPEND_STATUS_CREATE);
  if (zip == nullptr) return false;
  bool written = true;
  for (const ZipEntry& entry : entries) written = written && add(zip, entry);
  return zipClose(zip, nullptr) == ZIP_OK && written;
}

// Called before the file gets its name, so that a power cut leaves no broken file under that name.
bool reachesDisk(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0;
  ::close(fd);
  return synced;
}

}  // namespace

void writeZip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries) {
  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.new", ::getpid());
  errno = 0;
  const bool written = writeAll(temporary, entries) && reachesDisk(temporary);
  if (written && ::rename(temporary.c_str(), file.c_str()) == 0) return;
  const int cause = errno;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw Error({.what = "cannot write the zip file",
               .where = {.file = file.string()},
               .found = cause == 0 ? "" : std::strerror(cause)});
}

}  // namespace rex::grading
