#include "scene/find_scene.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

// A robot that has meshes has a folder of its own.
std::vector<fs::path> scenesIn(const fs::path& library) {
  std::vector<fs::path> scenes;
  std::error_code ignored;
  for (const char* folder : {"robots", "scenes"}) {
    for (const auto& entry : fs::directory_iterator(library / folder, ignored)) {
      const fs::path path = entry.path(), inner = path / path.filename().concat(".urdf");
      if (path.extension() == ".ors") scenes.push_back(path);
      if (isFile(inner)) scenes.push_back(inner);
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

}  // namespace

fs::path findScene(const fs::path& scene, const fs::path& library) {
  if (isFile(scene)) return scene;
  const std::vector<fs::path> known = scenesIn(library);
  std::vector<std::string> names, asTyped;
  for (const fs::path& one : known) {
    const bool isBare = !scene.empty() && !scene.has_parent_path();
    if (isBare && (scene == one.filename() || scene == one.stem())) return one;
    names.push_back(one.filename().string());
    asTyped.push_back(scene.has_extension() ? one.filename().string() : one.stem().string());
  }
  throw Error(
      {.what = fmt::format("there is no scene '{}'", scene.string()),
       .wanted = fmt::format("an .ors or .urdf file, or one of the course: {}", fmt::join(names, ", ")),
       .nearest = nearestNames(scene.filename().string(), asTyped)});
}

}  // namespace rex
