#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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
[[nodiscard]] Level parseLevel(int number);

/// "sandbox level 1 of 3", as users read it.
[[nodiscard]] std::string describe(Level level);

/// What programs at this level may still do, in one line; empty for the best.
[[nodiscard]] std::string levelWarning(Level level);

/// A file or folder of the machine that a confined program may read and execute.
struct Readable {
  std::filesystem::path path;    ///< absolute
  std::filesystem::path inside;  ///< its path at levels 2 and 3
};

/// What one confined program may see and use. share/doc/sandbox.md describes what each level prevents.
struct Confinement {
  Level level = Level::kLimitsOnly;
  std::vector<Readable> readable{};
  std::filesystem::path writable{};  ///< a folder to work in; empty: 32 MB in memory, nothing at level 1
  std::vector<std::string> environment{};  ///< NAME=VALUE, all variables
  bool mayStartProgramsOfItsOwn = false;   ///< for compilers; without reports, kReady begins standard error
  double cpuSeconds = 0;                   ///< per process, rounded up; 0: no limit
  double wallSeconds = 0;        ///< levels 2 and 3 then end it with ExitCode::kTimedOut; 0: no limit
  std::size_t addressSpace = 0;  ///< bytes per process; 0: no limit
  std::size_t fileSize = 0;      ///< bytes of the largest file; 0: no limit
  int openFiles = 64;
  int processes = 64;              ///< and threads, if the machine can count them for this program alone
  std::optional<unsigned> user{};  ///< user to switch to; only root can
  std::vector<std::filesystem::path> controlGroups{};  ///< process lists of the groups to join
  bool reports = false;                                ///< kReport is open, and 3 and 4 belong to the program
};

/// The path of a worker's program and its working folder at levels 2 and 3.
inline constexpr const char* kInsideProgram = "/program/main";
inline constexpr const char* kInsideFolder = "/tmp";

/// The descriptor to which the launcher writes its report, if requested: see probes.h. The program never
/// has it.
inline constexpr int kReport = 5;

/// Converts a confinement to the launcher's options, and back. Throws Error for unknown options.
[[nodiscard]] std::vector<std::string> toArguments(const Confinement& confinement);
struct Order {
  Confinement confinement;
  std::vector<std::string> command;  ///< what follows "--"
};
[[nodiscard]] Order orderFromArguments(const std::vector<std::string>& arguments);

}  // namespace rex::sandbox
