#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/level.h"

namespace rex::sandbox {

/// A file or folder of the machine that a confined program may read and execute.
struct Readable {
  std::filesystem::path path;    ///< absolute
  std::filesystem::path inside;  ///< where levels 2 and 3 show it
};

/// What one confined program may see and use. share/doc/sandbox.md says what the levels stop.
struct Confinement {
  Level level = Level::kLimitsOnly;
  std::vector<Readable> readable{};
  std::filesystem::path writable{};  ///< a folder to work in; empty: 32 MB of memory, at level 1 nothing
  std::vector<std::string> environment{};  ///< NAME=VALUE, all there are
  bool mayStartProgramsOfItsOwn = false;   ///< compilers do; without reports, kReady opens standard error
  double cpuSeconds = 0;                   ///< of each process, rounded up; 0: no limit
  double wallSeconds = 0;        ///< levels 2 and 3 end it then with ExitCode::kTimedOut; 0: no limit
  std::size_t addressSpace = 0;  ///< bytes of each process; 0: no limit
  std::size_t fileSize = 0;      ///< bytes of the largest file; 0: no limit
  int openFiles = 64;
  int processes = 64;              ///< and threads, where the machine can count those of this program alone
  std::optional<unsigned> user{};  ///< to become; only root can
  std::vector<std::filesystem::path> controlGroups{};  ///< to join: their lists of processes
  bool reports = false;                                ///< kReport is open, and 3 and 4 are the program's
};

/// Where levels 2 and 3 show the program of a worker, and where it works.
inline constexpr const char* kInsideProgram = "/rex/worker";
inline constexpr const char* kInsideFolder = "/tmp";

/// Where the launcher says what became of the program, if it should: see report.h. The program never holds
/// it.
inline constexpr int kReport = 5;

/// The options of the launcher for a confinement, and back. Throws Error for others.
[[nodiscard]] std::vector<std::string> toArguments(const Confinement& confinement);
struct Order {
  Confinement confinement;
  std::vector<std::string> command;  ///< what stands behind "--"
};
[[nodiscard]] Order orderFromArguments(const std::vector<std::string>& arguments);

}  // namespace rex::sandbox
