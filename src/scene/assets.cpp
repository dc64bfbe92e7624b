#include "scene/assets.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rex {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

fs::path real(const fs::path& path) {
  std::error_code ignored;
  const fs::path found = fs::weakly_canonical(path, ignored);
  return found.empty() ? fs::absolute(path).lexically_normal() : found;
}

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

bool isInside(const fs::path& path, const fs::path& root) {
  const fs::path inner = real(path), outer = real(root);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// Where the path within a package may lie: in a folder called like it above the scene, or in the root.
std::vector<fs::path> placesOf(const std::string& package, const fs::path& rest, const fs::path& folder,
                               const fs::path& root) {
  std::vector<fs::path> places;
  const fs::path top = real(root);
  for (fs::path above = real(folder); isInside(above, top); above = above.parent_path()) {
    if (above.filename() == package) places.push_back(above / rest);
    places.push_back(above / package / rest);
    if (above == top) break;
  }
  places.push_back(root / rest);
  return places;
}

std::vector<std::string> namesBeside(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::path file : files)
    for (const auto& entry : fs::directory_iterator(folderOf(file), ignored))
      names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

Assets::Assets(const fs::path& sceneFile, const fs::path& root)
    : folder_(folderOf(sceneFile)), root_(root.empty() ? folder_ / ".." : root) {}

fs::path Assets::find(const std::string& name, const SourceLocation& where, const std::string& what) const {
  const auto fail = [&](const std::string& found, const std::string& wanted) {
    throw Error({.what = what, .where = where, .found = found, .wanted = wanted});
  };
  std::vector<fs::path> places;
  if (name.starts_with(kPackage)) {
    const std::string path = name.substr(kPackage.size());
    const std::size_t slash = path.find('/');
    if (slash == 0 || slash == std::string::npos || slash + 1 == path.size())
      fail(fmt::format("'{}'", name), "package://PACKAGE/PATH");
    places = placesOf(path.substr(0, slash), path.substr(slash + 1), folder_, root_);
  } else if (name.find("://") != std::string::npos && !name.starts_with(kFile)) {
    fail(fmt::format("'{}'", name), "a file: nothing is fetched from a network");
  } else {
    places.push_back(folder_ / (name.starts_with(kFile) ? name.substr(kFile.size()) : name));
  }
  std::vector<std::string> tried;
  for (const fs::path& place : places) {
    if (!isInside(place, root_)) continue;
    if (isFile(place)) return place.lexically_normal();
    tried.push_back(place.lexically_normal().string());
  }
  if (tried.empty())
    fail(fmt::format("'{}'", name), fmt::format("a file inside the asset root {}", real(root_).string()));
  throw Error({.what = what,
               .where = where,
               .found = fmt::format("no file '{}'", name),
               .wanted = fmt::format("one of {}", fmt::join(tried, ", ")),
               .nearest = nearestNames(fs::path(name).filename().string(), namesBeside(tried))});
}

}  // namespace rex
