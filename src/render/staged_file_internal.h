#pragma once

#include <filesystem>
#include <string_view>

namespace rex::internal {

/// Puts `bytes` at `path` in one step: they go to a temporary name beside it, which is renamed when all is
/// written, so that a reader sees the old file or the whole new one. Throws Error naming the path.
void writeWhole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace rex::internal
