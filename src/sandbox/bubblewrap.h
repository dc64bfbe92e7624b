#pragma once

#include <string>
#include <vector>

#include "sandbox/confinement.h"

namespace rex::sandbox {

/// Where levels 2 and 3 show the launcher itself.
inline constexpr const char* kInsideLauncher = "/rex/enter";

/// The options of bubblewrap that make the namespaces and the files of a confinement of level 2 or 3. As root
/// it keeps the right to become another user, so that the launcher can; for others a namespace of users is
/// made.
[[nodiscard]] std::vector<std::string> bubblewrapOptions(const Confinement& confinement,
                                                         const std::filesystem::path& launcher);

/// The place inside of a file that the confinement shows, or the path itself.
[[nodiscard]] std::string insidePath(const Confinement& confinement, const std::string& path);

}  // namespace rex::sandbox
