#pragma once

#include <filesystem>

namespace rex {

/// A new empty folder that only this user may enter, removed with all it contains at the end.
class PrivateFolder {
 public:
  /// Makes it inside `parent`, and removes those there whose owners were killed an hour ago or more. Throws
  /// Error if that is impossible.
  explicit PrivateFolder(const std::filesystem::path& parent);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  ///< held as long as this lives
};

}  // namespace rex
