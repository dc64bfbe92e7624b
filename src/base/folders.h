#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rex {

/// Whether the path is the folder or lies in it, by their names alone: both absolute or both relative, and
/// without links and `..`.
[[nodiscard]] inline bool isBelow(const std::filesystem::path& folder, const std::filesystem::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

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

/// A new empty folder that only this user may enter, removed with its content when the object is destroyed.
class PrivateFolder {
 public:
  /// Makes it inside `parent`, and removes others there whose owners were killed at least an hour ago.
  /// Throws Error if that is impossible.
  explicit PrivateFolder(const std::filesystem::path& parent);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  ///< held while this object lives
};

/// The folder with rex's programs and, in lib/, its libraries: build/PRESET, or PREFIX/lib/rex where it is
/// installed. It is found from where this library was loaded, so an installed tree may be moved.
[[nodiscard]] const std::filesystem::path& ownFolder();

/// The folder of what is not compiled (data/, exercises/, share/), to which `home` in ownFolder() leads: the
/// root of the project, or PREFIX/share/rex. It may be missing; opening a file in it then fails.
[[nodiscard]] const std::filesystem::path& homeFolder();

/// Whether rex was installed: ownFolder() is no build folder.
[[nodiscard]] bool isInstalled();

/// Whether this path, absolute and without links, is or lies in one of these two folders.
[[nodiscard]] bool isOwnFile(const std::filesystem::path& path);

/// Removes what replaceTextFile() and others left in this folder, and down to that depth in folders in it,
/// when their process was killed: files NAME.PID.new of processes that have ended. Only for folders that no
/// other machine writes to meanwhile, whose processes look like ended ones here. Links are not followed; a
/// missing folder has no leftovers.
void removeLeftovers(const std::filesystem::path& folder, int depth = 0);

}  // namespace rex
