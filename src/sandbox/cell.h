#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/confinement.h"
#include "sandbox/control_group.h"
#include "sandbox/user_slot.h"

namespace rex::sandbox {

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
