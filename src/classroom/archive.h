#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/folders.h"

namespace rex::grading {

struct ArchiveFile {
  std::string name{};  ///< with slashes
  std::string text{};
  std::int64_t modifiedAt = 0;  ///< as the archive says, seconds since 1970 in UTC
};

/// Limits on one archive. If one is exceeded, the whole archive is rejected.
struct ArchiveLimits {
  int members = 200;                          ///< files and folders
  std::size_t bytes = std::size_t{20} << 20;  ///< for the archive, and for all its files together
  std::size_t ratio = 100;                    ///< size of its files relative to the archive
  std::size_t nameBytes = 255;
};

/// The contents of an archive.
struct ArchiveContent {
  struct LeftOut {
    std::string name{};
    std::string why{};  ///< "a symbolic link"
  };
  std::vector<ArchiveFile> files{};
  std::vector<LeftOut> leftOut{};  ///< links, pipes and devices; of a bundle also what breaks its rules
};

/// Whether the name ends in .zip, .tar, .tar.gz or .tgz.
[[nodiscard]] bool isArchiveName(const std::string& name);

/// The name without that ending.
[[nodiscard]] std::string withoutArchiveEnding(const std::string& name);

/// Reads the files of an archive into memory, in a separate process, and writes nothing. Names are
/// converted to UTF-8; names that are not UTF-8 in the archive are taken as code page 437. Throws Error
/// naming the member for a name that is absolute or leaves its folder, names that differ only in case, and
/// members that exceed the limits, are encrypted or broken.
[[nodiscard]] ArchiveContent readArchive(const std::filesystem::path& file, const ArchiveLimits& limits = {});

/// The same for an opened archive; `file` is for messages.
[[nodiscard]] ArchiveContent readArchive(const OpenedFile& opened, const std::filesystem::path& file,
                                         const ArchiveLimits& limits = {});

/// The same for the bytes of an archive, which may lie in another one.
[[nodiscard]] ArchiveContent readArchive(std::string_view bytes, const std::filesystem::path& file,
                                         const ArchiveLimits& limits = {});

/// Reads the files of many students that a platform packed together. What readArchive() would refuse the
/// whole archive for is left out with its reason, so that one student cannot hide the others: names that
/// leave their folder, the same name twice, encrypted files, and files of more than 20 MiB. Files that
/// `isWanted` does not name are listed without their text. Throws Error for a broken archive and for more
/// than 50 000 members or 512 MiB.
[[nodiscard]] ArchiveContent readBundle(const std::filesystem::path& file,
                                        const std::function<bool(const std::string& name)>& isWanted);

}  // namespace rex::grading
