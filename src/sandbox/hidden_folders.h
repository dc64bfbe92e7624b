#pragma once

#include <filesystem>
#include <vector>

namespace rex::sandbox {

/// The folders of an installed rex that lie below /usr, which confined programs otherwise see: the one of the
/// launcher, with libraries and graders, and the one to which its link `home` leads, with exercises. Paths
/// without links. Empty if rex lies elsewhere.
[[nodiscard]] std::vector<std::filesystem::path> hiddenFolders(const std::filesystem::path& launcher);

/// The smallest set of files and folders that covers everything below `folder` but not what is hidden.
/// Folders above hidden ones are divided into what they contain; links to such folders are left out.
[[nodiscard]] std::vector<std::filesystem::path> allBut(const std::filesystem::path& folder,
                                                        const std::vector<std::filesystem::path>& hidden);

}  // namespace rex::sandbox
