#include "scene/scene_file.h"

#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "scene/ors_reader.h"
#include "scene/urdf_reader.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseEnding(const fs::path& file) {
  const std::string ending = file.extension().string();
  throw Error({.what = "not a scene that rex reads",
               .where = {file.string()},
               .found = ending.empty() ? "no ending" : fmt::format("'{}'", ending),
               .wanted = ".ors or .urdf",
               .nearest = nearestNames(ending, {".ors", ".urdf"})});
}

}  // namespace

SceneFile readScene(const fs::path& file, const ReadOptions& options) {
  if (file.extension() == ".ors") return readOrs(file, options);
  if (file.extension() == ".urdf") return readUrdf(file, options);
  refuseEnding(file);
}

SceneFile parseScene(std::string_view text, const std::string& name, const ReadOptions& options) {
  return name.ends_with(".urdf") ? parseUrdf(text, name, options) : parseOrs(text, name, options);
}

std::string readSceneText(const fs::path& file, std::size_t most) {
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  std::ifstream stream(file, std::ios::binary);
  if (problem || !stream) {
    std::vector<std::string> neighbours;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    for (const auto& entry : fs::directory_iterator(folder, problem))
      neighbours.push_back(entry.path().filename().string());
    throw Error({.what = "cannot read the scene file",
                 .where = {file.string()},
                 .wanted = "an .ors or .urdf file",
                 .nearest = nearestNames(file.filename().string(), neighbours)});
  }
  if (size > most) {
    throw Error({.what = "scene file too large",
                 .where = {file.string()},
                 .found = fmt::format("{} bytes", size),
                 .wanted = fmt::format("at most {} MiB", most >> 20)});
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace rex
