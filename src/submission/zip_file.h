#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::grading {

struct ZipEntry {
  std::string name;  ///< with slashes: "01-kinematics/main.cpp"
  std::string text;
};

/// Writes a zip file that depends on the entries alone, not on the time; an old one is replaced at once.
/// Throws Error.
void writeZip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries);

}  // namespace rex::grading
