#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/confinement.h"

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

/// The id of a user who owns nothing on this machine, reserved for one program at a time, also across
/// processes. Only root can reserve one.
class UserSlot {
 public:
  /// Reserves the first free id; none unless called by root. Throws Error if all are taken.
  UserSlot();
  ~UserSlot();
  UserSlot(const UserSlot&) = delete;
  UserSlot& operator=(const UserSlot&) = delete;

  [[nodiscard]] std::optional<unsigned> user() const { return user_; }

 private:
  std::optional<unsigned> user_{};
  int lock_ = -1;
};

/// How programs are confined.
struct Sandbox {
  Level level = Level::kLimitsOnly;
  std::filesystem::path launcher{};  ///< the program rex-sandbox; not needed for limits only
};

/// The resources for confining one program: its own user (as root) and a control group (if the level has
/// one). Must outlive the program.
class Cell {
 public:
  /// Adds the level, user and groups to the confinement. Throws Error if they are not available.
  Cell(const Sandbox& sandbox, Confinement confinement);
  ~Cell();
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  /// The command that starts `program` with its arguments confined.
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& program) const;
  [[nodiscard]] bool ranOutOfMemory() const { return group_ && group_->ranOutOfMemory(); }
  /// Kills what may be left of the program.
  void kill() const;

 private:
  Sandbox sandbox_;
  std::optional<UserSlot> slot_{};
  std::optional<ControlGroup> group_{};
  Confinement confinement_;
};

}  // namespace rex::sandbox
