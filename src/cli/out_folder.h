#pragma once

#include <filesystem>

namespace rex::cli {

/// Makes the folder for a command's output unless it exists. Throws Error if that fails.
void makeOutFolder(const std::filesystem::path& folder);

/// The same for the parent folder of `out`, which is a file, or a folder if its name has no extension. Also
/// throws Error if `out` could not be written, before minutes of work are lost.
void makeOutPlace(const std::filesystem::path& out);

/// The folder for temporary files. Throws Error if TMPDIR does not name a folder.
[[nodiscard]] std::filesystem::path temporaryFolder();

}  // namespace rex::cli
