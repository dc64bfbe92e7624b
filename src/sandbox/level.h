#pragma once

#include <array>
#include <string>

namespace rex::sandbox {

/// The sandbox levels, with the numbers that users see. share/doc/sandbox.md describes what each level
/// prevents.
enum class Level : int {
  kLimitsOnly = 0,   ///< time, memory and output; no launcher is needed
  kFiles = 1,        ///< also landlock and a list of system calls
  kNamespaces = 2,   ///< also namespaces
  kControlGroup = 3  ///< also limits for all of its processes together
};

/// All levels that confine, best first.
inline constexpr std::array kConfiningLevels = {Level::kControlGroup, Level::kNamespaces, Level::kFiles};

[[nodiscard]] constexpr bool isConfined(Level level) { return level >= Level::kFiles; }
[[nodiscard]] constexpr bool hasNamespaces(Level level) { return level >= Level::kNamespaces; }
[[nodiscard]] constexpr bool hasControlGroup(Level level) { return level >= Level::kControlGroup; }
/// Whether strangers' submissions may be graded at this level without a warning.
[[nodiscard]] constexpr bool isForStrangers(Level level) { return hasNamespaces(level); }

[[nodiscard]] constexpr int numberOf(Level level) { return static_cast<int>(level); }
/// Throws Error unless it is 0 to 3.
[[nodiscard]] Level levelOf(int number);

/// "sandbox level 1 of 3", as users read it.
[[nodiscard]] std::string describe(Level level);

/// What programs at this level may still do, in one line; empty for the best.
[[nodiscard]] std::string warningOf(Level level);

}  // namespace rex::sandbox
