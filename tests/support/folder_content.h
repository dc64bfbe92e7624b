#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace rex {

/// The names of all that lies in a folder.
inline std::set<std::string> folderContent(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

}  // namespace rex
