#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/cell.h"

namespace rex::sandbox {

/// What the launcher wrote into its report, a pipe that the program never holds.
struct Report {
  bool ready = false;           ///< the sandbox was set up; what followed is the program's doing
  std::string error{};          ///< why the sandbox could not be set up
  std::optional<int> status{};  ///< how the program ended, as from wait4(); only at levels 2 and 3
};

/// The lines of the report.
inline constexpr const char* kReady = "ready\n";
[[nodiscard]] std::string errorLine(const std::string& message);
[[nodiscard]] std::string endLine(int status);
[[nodiscard]] Report readReport(const std::string& text);

/// One attack from inside the sandbox, by our own program.
struct Probe {
  std::string name;  ///< file, proc, net, fork, exec, lock, calls, a call, mem, fd, tmpfs size, leftover
  bool held = false;
  std::string text;  ///< how the attack ended, or what succeeded
  bool ran = true;   ///< false: there was no sandbox to attack, and `text` says why
};

/// Attacks the sandbox from inside in every way we know. Makes the files that it needs in `folder`. `probe`
/// is the program rex-sandbox-probe.
[[nodiscard]] std::vector<Probe> attack(const Sandbox& sandbox, const std::filesystem::path& probe,
                                        const std::filesystem::path& folder);

/// Checks that the sandbox starts and withstands the quick attacks: files, processes, network, descriptors,
/// locks, calls. Returns why not, or an empty text.
[[nodiscard]] std::string whyNot(const Sandbox& sandbox, const std::filesystem::path& probe,
                                 const std::filesystem::path& folder);

/// The best level that works here, and why each better one does not.
struct Available {
  Level level = Level::kLimitsOnly;
  std::vector<std::string> reasons{};
};
[[nodiscard]] Available bestLevel(const std::filesystem::path& launcher, const std::filesystem::path& probe,
                                  const std::filesystem::path& folder);

}  // namespace rex::sandbox
