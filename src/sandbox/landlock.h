#pragma once

#include <filesystem>
#include <vector>

namespace rex::sandbox {

/// The version of landlock that this kernel offers; 0: none.
[[nodiscard]] int landlockVersion();

/// Rules about files for this thread and what it starts. Made while everything can still be opened, enforced
/// later.
class FileRules {
 public:
  /// Nothing may be opened but what is allowed afterwards. Throws Error where the kernel has no landlock.
  FileRules();
  ~FileRules();
  FileRules(const FileRules&) = delete;
  FileRules& operator=(const FileRules&) = delete;

  /// A file, or a folder and all below it. What does not exist is left out.
  void allowReading(const std::filesystem::path& path);
  void allowWriting(const std::filesystem::path& path);
  /// From now on, for ever. Signals to, and memory of, processes outside are out of reach too, where the
  /// kernel can.
  void enforce();

 private:
  void allow(const std::filesystem::path& path, unsigned long long access);
  int version_;
  int fd_ = -1;
};

}  // namespace rex::sandbox
