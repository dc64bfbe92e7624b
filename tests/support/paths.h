#pragma once

#include <filesystem>

#include "base/folders.h"

namespace rex {

// The folders are asked for while a test runs: written into its code they would make it differ in each clone,
// and ccache would compile it again.

/// A file of the project, such as sourcePath("data/robots/man.ors").
inline std::filesystem::path sourcePath(const std::filesystem::path& relative) {
  return homeFolder() / relative;
}

/// A file of the build, such as buildPath("rex").
inline std::filesystem::path buildPath(const std::filesystem::path& relative) {
  return ownFolder() / relative;
}

/// A file of the papers and sample data that may lie beside the project; tests that use one skip where it is
/// absent.
inline std::filesystem::path sharedPath(const std::filesystem::path& relative) {
  return sourcePath("../shared") / relative;
}

}  // namespace rex
