#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::submission {

/// Beside a file that was made and kept: what haveStamps() reads.
[[nodiscard]] std::filesystem::path recordFile(const std::filesystem::path& kept);

/// A line for each of these files that something was made from: the time of its last change, and its path.
/// Empty if one of them is missing, or changed after `started`, when the making began: then nobody knows
/// which version was read.
[[nodiscard]] std::string timeStamps(const std::vector<std::filesystem::path>& files,
                                     std::filesystem::file_time_type started);

/// Whether each of the files has the time in its line; false without a line. The files of another version
/// of rex may be older than what was made before them, so it is not enough that they are not newer.
[[nodiscard]] bool haveStamps(std::string_view stamps);

}  // namespace rex::submission
