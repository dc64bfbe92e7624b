#include "formats/scene_file.h"

#include <cctype>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/assets_internal.h"
#include "formats/mjcf_reader.h"
#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"

namespace rex {
namespace {

namespace fs = std::filesystem;
using namespace internal;

bool isXacro(const fs::path& file) { return endingOf(file) == ".xacro"; }

[[noreturn]] void refuseEnding(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (isXacro(file))
    throw Error({.what = "this is xacro, not yet URDF",
                 .where = {file.string()},
                 .wanted = "plain URDF: run 'xacro FILE > robot.urdf' and read that"});
  throw Error({.what = "not a scene that rex reads",
               .where = {file.string()},
               .found = ending.empty() ? "no ending" : fmt::format("'{}'", ending),
               .wanted = ".ors, .urdf or .xml (MuJoCo)",
               .nearest = nearestNames(ending, {".ors", ".urdf", ".xml"})});
}

// A message without its quoted names and without numbers.
std::string kindOf(const std::string& message) {
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::string kind;
  for (std::size_t i = 0; i < message.size(); ++i) {
    const bool isAtStart = i == 0 || !isWord(message[i - 1]);
    if (message[i] == '\'' && isAtStart) {
      const std::size_t end = message.find('\'', i + 1);
      if (end != std::string::npos) i = end;
      kind += '\'';
    } else if (message[i] == '-' && isAtStart) {
      continue;  // of a number
    } else if (isAtStart && std::isdigit(static_cast<unsigned char>(message[i])) != 0) {
      const auto goesOn = [&](char c) {
        return isWord(c) || c == '.' || ((c == '-' || c == '+') && message[i] == 'e');
      };
      while (i + 1 < message.size() && goesOn(message[i + 1])) ++i;
      kind += '0';
    } else {
      kind += message[i];
    }
  }
  return kind;
}

}  // namespace

Diagnostics grouped(const Diagnostics& notes) {
  std::map<std::pair<Severity, std::string>, std::pair<std::size_t, int>> known;  // place and count
  Diagnostics all;
  for (const Diagnostic& one : notes) {
    const auto [kind, isNew] = known.try_emplace({one.severity, kindOf(one.message)}, all.size(), 0);
    if (isNew) all.push_back(one);
    ++kind->second.second;
  }
  for (const auto& [kind, place] : known)
    if (place.second > 1)
      all[place.first].message += fmt::format(" (and {} more like this)", place.second - 1);
  return all;
}

SceneFile readScene(const fs::path& file, const ReadOptions& options) {
  if (endingOf(file) == ".ors") return readOrs(file, options);
  if (endingOf(file) == ".urdf") return readUrdf(file, options);
  if (endingOf(file) == ".xml") return readMjcf(file, options);
  refuseEnding(file);
}

SceneFile parseScene(std::string_view text, const std::string& name, const ReadOptions& options) {
  if (isXacro(name)) refuseEnding(name);
  if (endingOf(name) == ".xml") return parseMjcf(text, name, options);
  return endingOf(name) == ".urdf" ? parseUrdf(text, name, options) : parseOrs(text, name, options);
}

std::string readSceneText(const fs::path& file, std::size_t most) {
  if (const std::string obstacle = obstacleAt(file); !obstacle.empty()) {
    throw Error({.what = "cannot read the scene file",
                 .where = {file.string()},
                 .found = obstacle,
                 .wanted = "an .ors, .urdf or .xml file",
                 .nearest = nearestNames(file.filename().string(), namesBeside(file))});
  }
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  std::ifstream stream(file, std::ios::binary);
  if (!problem && size > most) {
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
