#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rex {

/// A descriptor of a file that is closed with it.
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

/// A folder that was opened once. What is in it is opened by name and never through a link, so whatever its
/// owner renames or swaps meanwhile, nothing outside of it is reached.
class OpenedFolder {
 public:
  /// Follows links in `path`, which comes from the user. Throws Error with the reason of the system.
  explicit OpenedFolder(const std::filesystem::path& path);

  struct Entry {
    std::string name{};
    std::filesystem::file_type type{};  ///< a link is a link
  };
  /// What is in it, by name. Throws Error.
  std::vector<Entry> entries() const;
  /// What that entry is now: not_found for none.
  std::filesystem::file_type typeOf(const std::string& name) const;

  /// Throws Error where that entry is no longer a folder.
  OpenedFolder folder(const std::string& name) const;
  /// For reading, without waiting for a pipe. Throws Error with "a symbolic link", "no file" or the reason of
  /// the system as what was found.
  OpenedFile file(const std::string& name) const;

  /// How it was called, for messages.
  const std::filesystem::path& path() const { return path_; }
  std::int64_t modifiedAt() const { return file_.modifiedAt(); }

 private:
  OpenedFolder(OpenedFile file, std::filesystem::path path);
  OpenedFile file_;
  std::filesystem::path path_;
};

}  // namespace rex
