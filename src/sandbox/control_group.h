#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace rex::sandbox {

/// Limits on the memory and the number of processes of one program with all it starts, by control groups of
/// version 2 or 1. The program joins by writing itself into each list of processes().
class ControlGroup {
 public:
  /// Throws Error where this user can make none.
  ControlGroup(std::size_t memoryBytes, int processes);
  /// Kills what is left inside and removes it.
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  [[nodiscard]] std::vector<std::filesystem::path> processes() const;
  /// Whether the kernel had to end a process because the memory was used up.
  [[nodiscard]] bool ranOutOfMemory() const;
  /// Ends all processes inside.
  void kill() const;

 private:
  bool tryVersion2(std::size_t memoryBytes, int processes);
  bool tryVersion1(std::size_t memoryBytes, int processes);
  void remove();
  std::vector<std::filesystem::path> folders_;
};

}  // namespace rex::sandbox
