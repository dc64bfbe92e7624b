#include "cli/scene_option.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/terminal.h"
#include "scene/scene_file.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

std::vector<std::string> robotsIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".ors") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Meant as the user writes them, with their ending or without.
std::vector<std::string> nearestRobots(const fs::path& scene, std::vector<std::string> robots) {
  if (!scene.has_extension())
    for (std::string& robot : robots) robot = fs::path(robot).stem().string();
  return nearestNames(scene.filename().string(), robots);
}

// A file where the user is comes before a robot of the course.
fs::path find(const Project& project, const fs::path& scene) {
  if (isFile(scene)) return scene;
  const fs::path folder = project.root / "data" / "robots";
  if (!scene.empty() && !scene.has_parent_path()) {
    for (const char* ending : {"", ".ors"}) {
      if (const fs::path robot = folder / (scene.string() + ending); isFile(robot)) return shown(robot);
    }
  }
  const std::vector<std::string> robots = robotsIn(folder);
  throw UsageError({.what = fmt::format("there is no scene '{}'", harmless(scene.string())),
                    .wanted = fmt::format("an .ors file, or one of the course: {}", fmt::join(robots, ", ")),
                    .nearest = nearestRobots(scene, robots)});
}

}  // namespace

Model loadScene(const Project& project, const fs::path& scene) {
  SceneFile file = readScene(find(project, scene));
  for (const Diagnostic& one : file.notes) note(toString(one));
  file.spec.name = scene.filename().string();
  return compile(file.spec);
}

}  // namespace rex::cli
