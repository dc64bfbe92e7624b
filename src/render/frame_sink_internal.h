#pragma once

#include <filesystem>
#include <string_view>

namespace rex::internal {

/// A file in the making, beside the place where it is to stand: a reader of that place sees the old file or
/// the whole new one. What is not committed goes away.
class StagedFile {
 public:
  /// Makes an empty file. Throws Error naming `path`.
  explicit StagedFile(const std::filesystem::path& path);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Where to write; absolute.
  const std::filesystem::path& part() const { return part_; }
  /// Puts what was written in its place. Throws Error naming `path`.
  void commit();

 private:
  std::filesystem::path path_, target_, part_;
};

/// Puts `bytes` at `path` in one step, by a StagedFile. Throws Error naming the path.
void writeWhole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace rex::internal
