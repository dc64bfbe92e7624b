#include "scene/find_scene.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/lower_case.h"
#include "scene/files_internal.h"

namespace rex {
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
