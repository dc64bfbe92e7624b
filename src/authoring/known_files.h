#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rex::grading {

/// The files below `root` that are in its git history or index, as "src/a.h"; empty if root has no .git of
/// its own. Throws Error naming a file in `places` (names below root) that is neither known to git nor
/// ignored by .gitignore, because nobody has decided what to do with it. Also throws Error if git fails.
[[nodiscard]] std::optional<std::set<std::string>> knownFiles(const std::filesystem::path& root,
                                                              const std::vector<std::string>& places);

}  // namespace rex::grading
