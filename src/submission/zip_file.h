#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::submission {

struct ZipEntry {
  std::string name;  ///< with slashes: "01-kinematics/main.cpp"
  std::string text;
};

/// Writes a zip file that depends only on the entries, not on the time. An old one is replaced atomically.
/// Throws Error if it cannot be written.
void writeZip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries);

}  // namespace rex::submission
