#pragma once

#include <filesystem>

namespace rex::grading {

/// A new empty folder that only this user may enter, removed with all it contains at the end.
class PrivateFolder {
 public:
  /// Makes it inside `parent`. Throws Error if that is impossible.
  explicit PrivateFolder(const std::filesystem::path& parent);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace rex::grading
