#include "scene/assets.h"

#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/join.h"
#include "scene/files_internal.h"

namespace rex {
namespace {

namespace fs = std::filesystem;
using namespace internal;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

// Where a path within a package may lie: in a folder named after the package above the scene, or in the
// root.
std::vector<fs::path> placesOf(const std::string& package, const fs::path& rest, const fs::path& folder,
                               const fs::path& root) {
  std::vector<fs::path> places;
  const fs::path top = realPath(root);
  for (fs::path above = realPath(folder); isInside(above, top); above = above.parent_path()) {
    if (above.filename() == package) places.push_back(above / rest);
    places.push_back(above / package / rest);
    if (above == top) break;
  }
  if (!package.empty()) places.push_back(root / rest);  // otherwise it is among them already
  return places;
}

// The paths, with links followed, at which the scene may mean the file. Only those inside the root count.
std::vector<fs::path> inRoot(const std::vector<fs::path>& places, const fs::path& root) {
  std::vector<fs::path> inside;
  for (const fs::path& place : places)
    if (isInside(place, root)) inside.push_back(realPath(place));
  return inside;
}

std::vector<std::string> namesBesideAll(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) {
    const std::vector<std::string> more = namesBeside(file);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

}  // namespace

bool namesNoPackage(std::string_view file) {
  return file.starts_with(kPackage) && file.substr(kPackage.size()).starts_with('/');
}

Assets::Assets(const fs::path& sceneFile, const fs::path& root, bool needsNoPackage)
    : folder_(folderOf(sceneFile)),
      root_(root.empty() ? folder_ / ".." : root),
      needsNoPackage_(needsNoPackage) {
  if (!root.empty() && !fs::is_directory(root))
    throw Error({.what = "the folder of all assets",
                 .found = fmt::format("no such folder: {}", realPath(root).string()),
                 .wanted = "a folder"});
}

fs::path Assets::find(const std::string& name, const SourceLocation& where, const std::string& what) const {
  const auto fail = [&](const std::string& found, const std::string& wanted) {
    throw Error({.what = what, .where = where, .found = found, .wanted = wanted});
  };
  std::vector<fs::path> places;
  if (name.starts_with(kPackage)) {
    const std::string path = name.substr(kPackage.size());
    const std::size_t slash = path.find('/');
    if ((slash == 0 && !needsNoPackage_) || slash == std::string::npos || slash + 1 == path.size())
      fail(fmt::format("'{}'", name), "package://PACKAGE/PATH");
    places = placesOf(path.substr(0, slash), path.substr(slash + 1), folder_, root_);
  } else if (name.find("://") != std::string::npos && !name.starts_with(kFile)) {
    fail(fmt::format("'{}'", name), "a file: nothing is fetched from a network");
  } else {
    places.push_back(folder_ / (name.starts_with(kFile) ? name.substr(kFile.size()) : name));
  }
  const std::vector<fs::path> tried = inRoot(places, root_);
  if (tried.empty())
    fail(fmt::format("'{}'", name), fmt::format("a file inside the asset root {}", realPath(root_).string()));
  std::vector<std::string> paths;
  for (const fs::path& path : tried) {
    const std::string obstacle = obstacleAt(path);
    if (obstacle.empty()) return path;
    if (obstacle != kNoSuchFile) fail(fmt::format("{}: {}", obstacle, path.string()), "a file");
    paths.push_back(path.string());
  }
  throw Error({.what = what,
               .where = where,
               .found = fmt::format("no file '{}'", name),
               .wanted = fmt::format("{}{}", paths.size() > 1 ? "one of " : "", join(paths, ", ")),
               .nearest = nearestNames(fs::path(name).filename().string(), namesBesideAll(tried))});
}

}  // namespace rex
