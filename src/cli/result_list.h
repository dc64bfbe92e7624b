#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::cli {

/// All files below the folder with that extension (empty: any) except hidden ones, sorted by name; none if
/// the folder does not exist.
[[nodiscard]] std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                                         std::string_view ending = "");

/// The files as a user would type them, one per line; if a folder has more than six of one kind, only the
/// first and the last.
[[nodiscard]] std::vector<std::string> shortList(const std::vector<std::filesystem::path>& files);

}  // namespace rex::cli
