#pragma once

#include <filesystem>
#include <string>

namespace rex {

/// An empty folder of the build tree. What a test leaves in it stays until the next run, to be looked at.
inline std::filesystem::path freshFolder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(REX_BINARY_DIR) / "tests-out" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace rex
