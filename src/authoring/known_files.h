#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rex::grading {

/// The files below `root` that its git history or index has, as "src/a.h"; nothing where root has no .git of
/// its own. Throws Error, naming one, where there are others in `places` (names below root) that .gitignore
/// does not name: nobody has decided what becomes of them. Throws Error when git does not answer, too.
[[nodiscard]] std::optional<std::set<std::string>> knownFiles(const std::filesystem::path& root,
                                                              const std::vector<std::string>& places);

}  // namespace rex::grading
