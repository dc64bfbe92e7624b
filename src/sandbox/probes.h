#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sandbox/cell.h"

namespace rex::sandbox {

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
