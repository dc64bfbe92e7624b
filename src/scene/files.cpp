#include <algorithm>
#include <fstream>
#include <system_error>

#include "base/is_below.h"
#include "scene/files_internal.h"

namespace rex::internal {

namespace fs = std::filesystem;

bool isRegularFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string obstacleAt(const fs::path& path) {
  constexpr const char* kForbidden = "no permission to read it";
  std::error_code problem;
  const fs::file_status status = fs::status(path, problem);
  if (problem == std::errc::permission_denied) return kForbidden;
  if (!fs::exists(status)) return kNoSuchFile;
  if (fs::is_directory(status)) return "a folder";
  if (!fs::is_regular_file(status)) return "a pipe or device";
  return std::ifstream(path) ? "" : kForbidden;
}

fs::path realPath(const fs::path& path) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(path, ignored);
  const fs::path found = fs::weakly_canonical(whole, ignored);
  return found.empty() ? whole.lexically_normal() : found;
}

bool isInside(const fs::path& path, const fs::path& root) { return isBelow(realPath(root), realPath(path)); }

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

std::vector<std::string> namesBeside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folderOf(file), ignored))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace rex::internal
