#pragma once
// The options for bubblewrap, which confines programs at levels 2 and 3.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sandbox/confinement.h"

namespace rex::sandbox {

/// The folders of an installed rex that lie below /usr, which confined programs otherwise see: the one of the
/// launcher, with libraries and graders, and the one to which its link `home` leads, with exercises. Paths
/// without links. Empty if rex lies elsewhere.
[[nodiscard]] std::vector<std::filesystem::path> hiddenFolders(const std::filesystem::path& launcher);

/// The smallest set of files and folders that covers everything below `folder` but not what is hidden.
/// Folders above hidden ones are divided into what they contain; links to such folders are left out.
[[nodiscard]] std::vector<std::filesystem::path> allBut(const std::filesystem::path& folder,
                                                        const std::vector<std::filesystem::path>& hidden);

/// Words for a system call, as a null-terminated list of pointers at a random address of at least 34 bits:
/// three of them cannot be guessed together. They stay until the process executes another program. Throws
/// Error if there is no memory.
[[nodiscard]] char* const* hiddenWords(const std::vector<std::string>& words);

/// The same for one word.
[[nodiscard]] const char* hiddenWord(const std::string& word);

/// The path of the launcher inside levels 2 and 3.
inline constexpr const char* kInsideLauncher = "/rex/enter";

/// The bubblewrap options that make the namespaces and the files of a confinement of level 2 or 3. As root
/// it keeps the capability to change the user, which the launcher needs; other users get a user namespace.
[[nodiscard]] std::vector<std::string> bubblewrapOptions(const Confinement& confinement,
                                                         const std::filesystem::path& launcher);

/// The path inside the sandbox of a file that the confinement shows, or else the path itself.
[[nodiscard]] std::string insidePath(const Confinement& confinement, const std::string& path);

}  // namespace rex::sandbox
