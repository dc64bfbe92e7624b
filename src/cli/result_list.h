#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::cli {

/// All files below the folder with that ending (empty: any), hidden ones aside, by name; none where there is
/// no folder.
[[nodiscard]] std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                                         std::string_view ending = "");

/// The files as a user would type them, one per line; of more than six of one kind in a folder only the ends.
[[nodiscard]] std::vector<std::string> shortList(const std::vector<std::filesystem::path>& files);

}  // namespace rex::cli
