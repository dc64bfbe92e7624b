#pragma once

#include <algorithm>
#include <filesystem>

namespace rex {

/// Whether the path is the folder or lies in it, by their names alone: both absolute or both relative, and
/// without links and `..`.
[[nodiscard]] inline bool isBelow(const std::filesystem::path& folder, const std::filesystem::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace rex
