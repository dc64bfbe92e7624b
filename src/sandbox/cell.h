#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/confinement.h"
#include "sandbox/control_group.h"
#include "sandbox/user_slot.h"

namespace rex::sandbox {

/// How programs are confined here.
struct Sandbox {
  Level level = Level::kLimitsOnly;
  std::filesystem::path launcher{};  ///< the program rex-sandbox; not needed for limits only
};

/// A place for one program: what must be made before and taken away after, a user of its own (as root) and a
/// control group (if the level has one). Lives longer than the program.
class Cell {
 public:
  /// Completes the confinement with the level, user and groups. Throws Error where they cannot be had.
  Cell(const Sandbox& sandbox, Confinement confinement);
  ~Cell();
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  /// The command that starts `program` with its arguments confined.
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& program) const;
  [[nodiscard]] bool ranOutOfMemory() const { return group_ && group_->ranOutOfMemory(); }
  /// Ends what may be left of the program.
  void kill() const;

 private:
  Sandbox sandbox_;
  std::optional<UserSlot> slot_{};
  std::optional<ControlGroup> group_{};
  Confinement confinement_;
};

}  // namespace rex::sandbox
