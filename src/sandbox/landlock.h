#pragma once

#include <filesystem>
#include <vector>

namespace rex::sandbox {

/// The landlock version that this kernel supports; 0: none.
[[nodiscard]] int landlockVersion();

/// File access rules for this thread and what it starts. Make them while everything can still be opened,
/// and enforce them later.
class FileRules {
 public:
  /// Initially nothing may be opened; the calls below add exceptions. Throws Error if the kernel has no
  /// landlock.
  FileRules();
  ~FileRules();
  FileRules(const FileRules&) = delete;
  FileRules& operator=(const FileRules&) = delete;

  /// Allows a file, or a folder and everything below it. A path that does not exist is ignored.
  void allowReading(const std::filesystem::path& path);
  void allowWriting(const std::filesystem::path& path);
  /// Enforces the rules permanently. If the kernel can, it also prevents sending signals to processes
  /// outside and accessing their memory.
  void enforce();

 private:
  void allow(const std::filesystem::path& path, unsigned long long access);
  int version_;
  int fd_ = -1;
};

}  // namespace rex::sandbox
