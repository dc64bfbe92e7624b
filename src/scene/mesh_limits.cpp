#include <algorithm>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/join.h"
#include "base/lower_case.h"
#include "scene/mesh_limits_internal.h"
#include "scene/mesh_text_internal.h"

namespace rex::mesh {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostNodesDeep = 5'000;
constexpr int kMostBrackets = 100;

struct Kind {
  const char* ending;
  std::size_t mostMiB;
};
constexpr Kind kKinds[] = {{".stl", 32},  {".obj", 16}, {".ply", 32}, {".dae", 16},
                           {".gltf", 16}, {".glb", 32}, {".off", 16}};

void requireNodes(std::size_t deep, const std::string& name) {
  if (deep > kMostNodesDeep)
    fail(name, "mesh file", fmt::format("nodes nested {} deep", deep),
         fmt::format("at most {}", kMostNodesDeep));
}

// assimp searches forever for the end of a list that holds anything else.
void requireIndices(std::string_view text, const std::string& name) {
  const std::size_t end = text.find_first_not_of("0123456789 \t\r\n");
  if (end != std::string_view::npos && text[end] != '<')
    fail(name, "DAE file", "a list of indices that holds something else, too", "whole numbers");
}

void checkCollada(std::string_view xml, const std::string& name) {
  constexpr std::string_view kCount = "count=";
  std::size_t open = 0;
  for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    const std::string_view tag = xml.substr(at, xml.find('>', at) - at);
    at += tag.size();
    const std::string_view element = tag.substr(0, tag.find_first_of(" \t\r\n"));
    if (element == "<p" || element == "<vcount")
      requireIndices(xml.substr(std::min(at + 1, xml.size())), name);
    if (tag.starts_with("</node")) open -= open > 0 ? 1 : 0;
    if (tag.starts_with("<node") && !tag.ends_with('/')) requireNodes(++open, name);
    if (const std::size_t count = tag.find(kCount); count != std::string_view::npos && count + 7 < tag.size())
      requireCount(numberAt(tag.substr(count + kCount.size() + 1)), name, 3 * kMostTriangles);
  }
}

// The JSON of a binary glTF file, which is its first chunk. assimp does not check the sizes of chunks
// against the size of the file.
std::string_view jsonOfGlb(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kHead = 12, kPartHead = 8;
  std::string_view json, rest = bytes.substr(std::min(kHead, bytes.size()));
  for (int part = 0; part < 2 && rest.size() >= kPartHead; ++part) {
    std::uint32_t length = 0;
    std::memcpy(&length, rest.data(), sizeof(length));
    rest.remove_prefix(kPartHead);
    if (length > rest.size())
      fail(name, "GLB file", fmt::format("a chunk of {} bytes", length),
           fmt::format("at most the {} that follow", rest.size()));
    if (part == 0) json = rest.substr(0, length);
    rest.remove_prefix(length);
  }
  return json;
}

int bracketsDeep(std::string_view json) {
  int open = 0, deepest = 0;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json[i] == '{' || json[i] == '[') deepest = std::max(deepest, ++open);
    if (json[i] == '}' || json[i] == ']') --open;
    if (json[i] != '"') continue;
    for (++i; i < json.size() && json[i] != '"'; ++i)
      if (json[i] == '\\') ++i;
  }
  return deepest;
}

const Json& at(const Json& parent, const char* key) {
  static const Json kNone;
  const auto found = parent.is_object() ? parent.find(key) : parent.end();
  return parent.is_object() && found != parent.end() ? *found : kNone;
}

// How many elements of an accessor a primitive uses. They are copied for each primitive that uses them.
std::size_t countOf(const Json& accessors, const Json& index) {
  if (!index.is_number_unsigned() || !accessors.is_array() || index.get<std::size_t>() >= accessors.size())
    return 0;
  const Json& count = at(accessors[index.get<std::size_t>()], "count");
  return count.is_number_unsigned() ? std::min<std::size_t>(count.get<std::size_t>(), 3 * kMostTriangles + 1)
                                    : 0;
}

void checkGltf(std::string_view text, const std::string& name) {
  if (const int deep = bracketsDeep(text); deep > kMostBrackets)
    fail(name, "mesh file", fmt::format("brackets nested {} deep", deep),
         fmt::format("at most {}", kMostBrackets));
  const Json json = Json::parse(text, nullptr, false);
  std::size_t vertices = 0, corners = 0;
  for (const Json& mesh : at(json, "meshes"))
    for (const Json& primitive : at(mesh, "primitives")) {
      vertices += countOf(at(json, "accessors"), at(at(primitive, "attributes"), "POSITION"));
      corners += countOf(at(json, "accessors"), at(primitive, "indices"));
      requireCount(vertices, name);
      requireCount(corners, name, 3 * kMostTriangles);
    }
  // An upper bound on how deep nodes may be nested.
  std::size_t parents = 0;
  for (const Json& node : at(json, "nodes")) parents += at(node, "children").empty() ? 0 : 1;
  requireNodes(parents, name);
}

}  // namespace

void fail(const std::string& name, std::string what, std::string found, std::string wanted,
          std::vector<std::string> nearest) {
  throw Error({std::move(what), {.file = name}, std::move(found), std::move(wanted), std::move(nearest)});
}

std::size_t largestFile(const std::string& name) {
  const std::string ending = endingOf(name);
  std::vector<std::string> known;
  for (const Kind& kind : kKinds) {
    if (ending == kind.ending) return kind.mostMiB << 20;
    known.emplace_back(kind.ending);
  }
  fail(name, "not a mesh file that rex can read", ending.empty() ? "no ending" : fmt::format("'{}'", ending),
       join(known, ", "), nearestNames(ending, known));
}

void requireSize(std::size_t bytes, const std::string& name) {
  const std::size_t most = largestFile(name);
  if (bytes > most)
    fail(name, "mesh file too large", fmt::format("{} bytes", bytes),
         fmt::format("at most {} MiB", most >> 20));
}

void requireCount(std::size_t count, const std::string& name, std::size_t most) {
  if (count > most)
    fail(name, "mesh too large", fmt::format("a count of {}", count), fmt::format("at most {}", most));
}

void requireTriangles(std::size_t count, const std::string& name) {
  if (count > kMostTriangles)
    fail(name, "mesh too large", fmt::format("{} triangles", count),
         fmt::format("at most {}", kMostTriangles));
}

void requireHarmless(std::string_view bytes, const std::string& name) {
  const std::string ending = endingOf(name);
  if (ending == ".stl") checkStl(bytes, name);
  if (ending == ".obj") checkObj(bytes, name);
  if (ending == ".ply") checkPly(bytes, name);
  if (ending == ".off") checkOff(bytes, name);
  if (ending == ".dae") checkCollada(bytes, name);
  if (ending == ".gltf") checkGltf(bytes, name);
  if (ending == ".glb") checkGltf(jsonOfGlb(bytes, name), name);
}

}  // namespace rex::mesh
