#pragma once

#include <filesystem>

namespace rex {

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

}  // namespace rex
