#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rex {

/// A file descriptor that is closed with this object.
class OpenedFile {
 public:
  explicit OpenedFile(int fd) : fd_(fd) {}
  OpenedFile(OpenedFile&& other) noexcept;
  OpenedFile& operator=(OpenedFile&&) = delete;
  ~OpenedFile();
  int fd() const { return fd_; }
  /// When it was modified, seconds since 1970 in UTC.
  std::int64_t modifiedAt() const;
  std::size_t size() const;  ///< bytes

 private:
  int fd_;
};

/// A folder that was opened once. Its entries are opened by name and never through a link, so whatever its
/// owner renames or swaps meanwhile, nothing outside it is reached.
class OpenedFolder {
 public:
  /// Follows links in `path`, which comes from the user. Throws Error with the system's reason.
  explicit OpenedFolder(const std::filesystem::path& path);

  struct Entry {
    std::string name{};
    std::filesystem::file_type type{};  ///< a link is a link
  };
  /// Its entries, sorted by name. Throws Error.
  std::vector<Entry> entries() const;
  /// The present type of that entry; not_found if it does not exist.
  std::filesystem::file_type typeOf(const std::string& name) const;

  /// Opens that entry as a folder. Throws Error if it no longer is one.
  OpenedFolder folder(const std::string& name) const;
  /// Opens that entry for reading, without waiting for a pipe. Throws Error with "a symbolic link", "no
  /// file" or the system's reason as what was found.
  OpenedFile file(const std::string& name) const;

  /// The path as it was given, for messages.
  const std::filesystem::path& path() const { return path_; }
  std::int64_t modifiedAt() const { return file_.modifiedAt(); }

 private:
  OpenedFolder(OpenedFile file, std::filesystem::path path);
  OpenedFile file_;
  std::filesystem::path path_;
};

}  // namespace rex
