#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::cli {

/// Makes the folder for a command's output unless it exists. Throws Error if that fails.
void makeOutFolder(const std::filesystem::path& folder);

/// The same for the parent folder of `out`, which is a file, or a folder if its name has no extension. Also
/// throws Error if `out` could not be written, before minutes of work are lost.
void makeOutPlace(const std::filesystem::path& out);

/// The folder for temporary files. Throws Error if TMPDIR does not name a folder.
[[nodiscard]] std::filesystem::path temporaryFolder();

/// All files below the folder with that extension (empty: any) except hidden ones, sorted by name; none if
/// the folder does not exist.
[[nodiscard]] std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                                         std::string_view ending = "");

/// The files as a user would type them, one per line; if a folder has more than six of one kind, only the
/// first and the last.
[[nodiscard]] std::vector<std::string> shortList(const std::vector<std::filesystem::path>& files);

}  // namespace rex::cli
