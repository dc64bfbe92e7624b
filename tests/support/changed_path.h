#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace rex {

/// While it lives, programs are looked for elsewhere: nowhere, or first in a folder.
class ChangedPath {
 public:
  ChangedPath() { ::setenv("PATH", "/nowhere", 1); }
  explicit ChangedPath(const std::filesystem::path& folder) {
    ::setenv("PATH", (folder.string() + ":" + before_).c_str(), 1);
  }
  ~ChangedPath() { ::setenv("PATH", before_.c_str(), 1); }
  ChangedPath(const ChangedPath&) = delete;
  ChangedPath& operator=(const ChangedPath&) = delete;

 private:
  std::string before_ = std::getenv("PATH");
};

/// Writes a shell script that stands for a program.
inline void writeProgram(const std::filesystem::path& file, const std::string& script) {
  std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::all);
}

}  // namespace rex
