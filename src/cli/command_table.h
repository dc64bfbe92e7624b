#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rex::cli {

/// The programs behind the one that users see, one for each room of this folder. `rex` itself is the
/// student's.
enum class Program { kStudent, kRobot, kMethods, kInstructor };

/// Its name: that of its file in the build folder, and of its target there.
[[nodiscard]] std::string programName(Program program);

/// What every program knows of a command, also of those that it has to hand over.
struct TableEntry {
  std::string_view name{};
  std::string_view purpose{};  ///< one line of `rex --help`
  Program program{};           ///< that does the work
};

/// All commands of `rex`, in the order of its help.
[[nodiscard]] std::span<const TableEntry> commandTable();

}  // namespace rex::cli
