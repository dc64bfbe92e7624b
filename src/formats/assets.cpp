#include "formats/assets.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/text.h"
#include "formats/assets_internal.h"

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

// The folders above a root, without that of the whole system.
std::vector<fs::path> above(const fs::path& root) {
  std::vector<fs::path> folders;
  for (fs::path at = realPath(root).parent_path(); at.has_relative_path(); at = at.parent_path())
    folders.push_back(at);
  return folders;
}

// A folder that may be a root, and the file that is found there.
struct WiderRoot {
  fs::path root, file;
};

// Where a package above the root has the file: each file once, with the nearest root.
std::vector<WiderRoot> packagesAbove(const std::string& package, const fs::path& rest, const fs::path& root) {
  std::vector<WiderRoot> found;
  for (const fs::path& wider : above(root)) {
    for (const fs::path& place :
         {wider.filename() == package ? wider / rest : fs::path(), wider / package / rest}) {
      const auto isKnown = [&](const WiderRoot& one) { return one.file == realPath(place); };
      if (!place.empty() && isInside(place, wider) && obstacleAt(place).empty() &&
          std::ranges::none_of(found, isKnown))
        found.push_back({wider, realPath(place)});
    }
  }
  return found;
}

// The nearest folder above the root that holds the file, for a message; empty without one.
std::string rootWith(const fs::path& file, const fs::path& root) {
  if (!isRegularFile(file)) return {};
  for (const fs::path& wider : above(root))
    if (isInside(file, wider)) return fmt::format("; --assets {} has it", wider.string());
  return {};
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
      hasUsualRoot_(root.empty()),
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
  std::vector<WiderRoot> wider;
  if (name.starts_with(kPackage)) {
    const std::string path = name.substr(kPackage.size());
    const std::size_t slash = path.find('/');
    if ((slash == 0 && !needsNoPackage_) || slash == std::string::npos || slash + 1 == path.size())
      fail(fmt::format("'{}'", name), "package://PACKAGE/PATH");
    places = placesOf(path.substr(0, slash), path.substr(slash + 1), folder_, root_);
    if (hasUsualRoot_ && slash > 0)
      wider = packagesAbove(path.substr(0, slash), path.substr(slash + 1), root_);
  } else if (name.find("://") != std::string::npos && !name.starts_with(kFile)) {
    fail(fmt::format("'{}'", name), "a file: nothing is fetched from a network");
  } else {
    places.push_back(folder_ / (name.starts_with(kFile) ? name.substr(kFile.size()) : name));
  }
  const std::vector<fs::path> tried = inRoot(places, root_);
  if (tried.empty())
    fail(fmt::format("'{}'", name), fmt::format("a file inside the asset root {}{}", realPath(root_).string(),
                                                rootWith(places.front(), root_)));
  std::vector<std::string> paths;
  for (const fs::path& path : tried) {
    const std::string obstacle = obstacleAt(path);
    if (obstacle.empty()) return path;
    if (obstacle != kNoSuchFile) fail(fmt::format("{}: {}", obstacle, path.string()), "a file");
    paths.push_back(path.string());
  }
  if (wider.size() == 1) return wider.front().file;
  std::vector<std::string> roots;
  for (const WiderRoot& one : wider) roots.push_back("--assets " + one.root.string());
  throw Error({.what = what,
               .where = where,
               .found = fmt::format("no file '{}'", name),
               .wanted = roots.empty()
                             ? fmt::format("{}{}", paths.size() > 1 ? "one of " : "", join(paths, ", "))
                             : "one of its packages: " + join(roots, " or "),
               .nearest = nearestNames(fs::path(name).filename().string(), namesBesideAll(tried))});
}

namespace {

namespace fs = std::filesystem;
using namespace internal;

// A robot with meshes has a folder of its own.
std::vector<fs::path> scenesIn(const fs::path& library) {
  std::vector<fs::path> scenes;
  std::error_code ignored;
  for (const char* folder : {"robots", "scenes"}) {
    for (const auto& entry : fs::directory_iterator(library / folder, ignored)) {
      const fs::path path = entry.path(), inner = path / path.filename().concat(".urdf");
      if (path.extension() == ".ors") scenes.push_back(path);
      if (isRegularFile(inner)) scenes.push_back(inner);
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

// A path means the file that lies there, a bare name may also mean a scene of the course.
[[noreturn]] void failAtPath(const fs::path& scene) {
  throw Error({.what = fmt::format("there is no scene '{}'", scene.string()),
               .wanted = "an .ors, .urdf or .xml file",
               .nearest = nearestNames(scene.filename().string(), namesBeside(scene))});
}

}  // namespace

fs::path findScene(const fs::path& scene, const fs::path& library) {
  if (isRegularFile(scene)) return scene;
  const bool isBare = !scene.empty() && !scene.has_parent_path();
  const fs::path meant = scene.stem().string() + endingOf(scene);
  std::vector<std::string> names, asTyped;
  for (const fs::path& one : scenesIn(library)) {
    if (isBare && (meant == one.filename() || meant == one.stem())) return one;
    names.push_back(one.filename().string());
    asTyped.push_back(scene.has_extension() ? one.filename().string() : one.stem().string());
  }
  const std::string obstacle = obstacleAt(scene);
  if (!scene.empty() && obstacle != kNoSuchFile)
    throw Error({.what = fmt::format("cannot read the scene '{}'", scene.string()),
                 .found = obstacle,
                 .wanted = "an .ors, .urdf or .xml file"});
  if (!isBare && !scene.empty()) failAtPath(scene);
  throw Error(
      {.what = fmt::format("there is no scene '{}'", scene.string()),
       .wanted = fmt::format("an .ors, .urdf or .xml file, or one of the course: {}", join(names, ", ")),
       .nearest = nearestNames(scene.filename().string(), asTyped)});
}

}  // namespace rex
