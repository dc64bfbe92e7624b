#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/opened_folder.h"

namespace rex::grading {

struct ArchiveFile {
  std::string name{};  ///< with slashes
  std::string text{};
};

/// The most that is taken out of one archive. More, and it is refused as a whole.
struct ArchiveLimits {
  int members = 200;                          ///< files and folders
  std::size_t bytes = std::size_t{20} << 20;  ///< of the archive, and of all its files together
  std::size_t ratio = 100;                    ///< of the bytes of its files to its own
  std::size_t nameBytes = 255;
};

/// What an archive holds.
struct ArchiveContent {
  struct LeftOut {
    std::string name{};
    std::string why{};  ///< "a symbolic link"
  };
  std::vector<ArchiveFile> files{};
  std::vector<LeftOut> leftOut{};  ///< what is not a file or folder: links, pipes, devices
};

/// Whether the name ends in .zip, .tar, .tar.gz or .tgz.
[[nodiscard]] bool isArchiveName(const std::string& name);

/// The name without that ending.
[[nodiscard]] std::string withoutArchiveEnding(const std::string& name);

/// Reads the files of an archive into memory, in a process of its own; writes nothing. Names are UTF-8,
/// whatever they were in the archive: what is not UTF-8 there counts as code page 437. Throws Error, which
/// names the member, for a name that is absolute or leaves its folder, for two names that are one where case
/// does not count, for what goes beyond the limits, is encrypted or broken.
[[nodiscard]] ArchiveContent readArchive(const std::filesystem::path& file, const ArchiveLimits& limits = {});

/// The same of one that was opened; `file` is for messages.
[[nodiscard]] ArchiveContent readArchive(const OpenedFile& opened, const std::filesystem::path& file,
                                         const ArchiveLimits& limits = {});

}  // namespace rex::grading
