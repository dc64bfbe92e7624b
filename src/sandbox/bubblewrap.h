#pragma once

#include <string>
#include <vector>

#include "sandbox/confinement.h"

namespace rex::sandbox {

/// The path of the launcher inside levels 2 and 3.
inline constexpr const char* kInsideLauncher = "/rex/enter";

/// The bubblewrap options that make the namespaces and the files of a confinement of level 2 or 3. As root
/// it keeps the capability to change the user, which the launcher needs; other users get a user namespace.
[[nodiscard]] std::vector<std::string> bubblewrapOptions(const Confinement& confinement,
                                                         const std::filesystem::path& launcher);

/// The path inside the sandbox of a file that the confinement shows, or else the path itself.
[[nodiscard]] std::string insidePath(const Confinement& confinement, const std::string& path);

}  // namespace rex::sandbox
