#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace rex::sandbox {

/// Limits the memory and the number of processes of one program and all its descendants, with control
/// groups of version 2 or 1. The program joins by writing itself into each list of processes().
class ControlGroup {
 public:
  /// Throws Error if this user cannot make one.
  ControlGroup(std::size_t memoryBytes, int processes);
  /// Kills all processes left in the group and removes it.
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  [[nodiscard]] std::vector<std::filesystem::path> processes() const;
  /// Whether the kernel killed a process because the memory was used up.
  [[nodiscard]] bool ranOutOfMemory() const;
  /// Kills all processes in the group.
  void kill() const;

 private:
  bool tryVersion2(std::size_t memoryBytes, int processes);
  bool tryVersion1(std::size_t memoryBytes, int processes);
  void remove();
  std::vector<std::filesystem::path> folders_;
};

}  // namespace rex::sandbox
