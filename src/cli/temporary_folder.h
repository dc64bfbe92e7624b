#pragma once

#include <filesystem>

namespace rex::cli {

/// Where temporary files go. Throws Error if TMPDIR names no folder.
[[nodiscard]] std::filesystem::path temporaryFolder();

}  // namespace rex::cli
