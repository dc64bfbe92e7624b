#pragma once

#include <filesystem>

namespace rex {

/// A file of the project, such as sourcePath("data/robots/man.ors").
inline std::filesystem::path sourcePath(const std::filesystem::path& relative) {
  return REX_SOURCE_DIR / relative;
}

/// A file of the papers and sample data that may lie beside the project; tests that use one skip where it is
/// absent.
inline std::filesystem::path sharedPath(const std::filesystem::path& relative) {
  return sourcePath("../shared") / relative;
}

}  // namespace rex
