#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/folders.h"

namespace rex::classroom {

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
  std::size_t nameBytes = 255;                ///< of a file or a folder, as file systems have it
  std::size_t pathBytes = 4096;
};

/// What is wanted of a member that was left out for this reason: a shorter name, else `otherwise`.
[[nodiscard]] std::string wantedInsteadOf(const std::string& why, const std::string& otherwise);

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

/// Limits what each student may put into a download of a class, so that one student cannot hide the others:
/// 5000 files, and 40 MiB in those that are read. A student is what follows the folder around all names: its
/// first folder or file, up to Moodle's "_assignsubmission_".
class StudentBudgets {
 public:
  explicit StudentBudgets(std::function<bool(const std::string& name)> isWanted)
      : isWanted_(std::move(isWanted)) {}

  /// Wants all names before the first file is added.
  void see(const std::string& name);
  /// False if the student of that name has too much by now.
  [[nodiscard]] bool add(const std::string& name, int files, std::size_t bytes);
  [[nodiscard]] bool isExceededBy(const std::string& name) const;
  /// One file of each student who has too much, with the reason.
  [[nodiscard]] std::vector<ArchiveContent::LeftOut> leftOut() const;

 private:
  struct Used {
    std::string example{};
    int files = 0;
    std::size_t bytes = 0;
  };
  std::string studentOf(const std::string& name) const;
  static std::string whyTooMuch(const Used& used);
  std::function<bool(const std::string& name)> isWanted_;
  std::optional<std::string> around_{};
  std::map<std::string, Used> used_{};
};

/// Reads the files of many students that a platform packed together. What readArchive() would refuse the
/// whole archive for is left out with its reason, so that one student cannot hide the others: names that
/// leave their folder, the same name twice, encrypted files, files of more than 20 MiB, and all files of a
/// student beyond StudentBudgets. Files that `isWanted` does not name are listed without their text. Throws
/// Error for a broken archive and for more than a million members, or 50 000 files or 512 MiB that count.
[[nodiscard]] ArchiveContent readBundle(const std::filesystem::path& file,
                                        const std::function<bool(const std::string& name)>& isWanted);

}  // namespace rex::classroom
