#pragma once

#include <filesystem>

namespace rex::cli {

/// Makes the folder for what a command writes, unless it is there. Throws Error.
void makeOutFolder(const std::filesystem::path& folder);

/// The same for the folder around `out`, a file, or a folder if its name has no ending. Throws Error also
/// where that could not be written, before anybody works for minutes on what goes into it.
void makeOutPlace(const std::filesystem::path& out);

/// Where temporary files go. Throws Error if TMPDIR names no folder.
[[nodiscard]] std::filesystem::path temporaryFolder();

}  // namespace rex::cli
