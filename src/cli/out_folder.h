#pragma once

#include <filesystem>

namespace rex::cli {

/// Makes the folder for what a command writes, unless it is there. Throws Error.
void makeOutFolder(const std::filesystem::path& folder);

}  // namespace rex::cli
