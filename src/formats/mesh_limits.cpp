#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "formats/mesh_limits_internal.h"

// The kinds of mesh files that are words in lines, or begin with such. assimp fills up what is missing in
// them, and crashes on some that are not quite right.
namespace rex::mesh {

/// The whole number at the begin of a text; 0 without, and as many as there can be for one that is too large.
[[nodiscard]] std::size_t numberAt(std::string_view text);

/// Throw Error naming the file if it is cut off, names vertices that it has not, has a header that assimp
/// does not bear, or asks for more than the limits allow.
void checkStl(std::string_view bytes, const std::string& name);
void checkObj(std::string_view bytes, const std::string& name);
void checkPly(std::string_view bytes, const std::string& name);
void checkOff(std::string_view bytes, const std::string& name);

namespace {

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view nextWord(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && isSpace(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !isSpace(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view nextLine(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

// How many triangles a face of an OBJ file becomes; the line without its first word.
std::size_t trianglesOf(std::string_view corners) {
  std::size_t count = 0;
  while (!nextWord(corners).empty()) ++count;
  return count - std::min<std::size_t>(count, 2);
}

bool isPlyType(std::string_view word, bool whole) {
  constexpr std::string_view kWhole[] = {"char", "uchar", "short", "ushort", "int",   "uint",
                                         "int8", "uint8", "int16", "uint16", "int32", "uint32"};
  constexpr std::string_view kReal[] = {"float", "double", "float32", "float64"};
  const auto holds = [&](const auto& types) {
    return std::find(std::begin(types), std::end(types), word) != std::end(types);
  };
  return holds(kWhole) || (!whole && holds(kReal));
}

struct PlyElement {
  std::size_t count = 0;
  std::vector<bool> isList{};  // of its properties
};

// "property float x" and "property list uchar int vertex_indices", without the first word.
bool readPlyProperty(std::string_view line, std::vector<PlyElement>& elements) {
  const std::string_view type = nextWord(line);
  const bool isList = type == "list";
  if (isList && (!isPlyType(nextWord(line), true) || !isPlyType(nextWord(line), false))) return false;
  if (!elements.empty()) elements.back().isList.push_back(isList);
  return (isList || isPlyType(type, false)) && !nextWord(line).empty();
}

// assimp makes up elements that are missing in a text.
void checkPlyText(std::string_view body, const std::vector<PlyElement>& elements, const std::string& name) {
  std::size_t whole = 0;
  for (const PlyElement& element : elements) {
    if (element.isList.empty()) continue;  // however many
    for (std::size_t i = 0; i < element.count; ++i, ++whole)
      for (const bool isList : element.isList) {
        const std::string_view word = nextWord(body);
        bool missing = word.empty();
        for (std::size_t k = isList ? numberAt(word) : 0; k > 0 && !missing; --k)
          missing = nextWord(body).empty();
        if (missing)
          fail(name, "PLY file", fmt::format("the end after {} elements", whole),
               "as many as its header says");
      }
  }
}

// A face of an OFF file: how many corners, and which. If a vertex does not exist, assimp takes another one.
void requireCorners(std::string_view face, std::size_t vertices, const std::string& name) {
  constexpr const char* kDigits = "0123456789";
  for (std::size_t left = numberAt(nextWord(face)); left > 0; --left) {
    const std::string_view corner = nextWord(face);
    if (corner.empty()) fail(name, "OFF file", "a face with missing corners", "as many as the face declares");
    if (corner.find_first_not_of(kDigits) != corner.npos || numberAt(corner) >= vertices)
      fail(name, "OFF file", fmt::format("a face with corner {}", corner),
           fmt::format("indices below {}, the number of vertices", vertices));
  }
}

}  // namespace

std::size_t numberAt(std::string_view text) {
  std::size_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc::result_out_of_range ? ~std::size_t{0} : number;
}

// assimp searches all materials and groups again for each one that it reads.
void checkObj(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kMostGroups = 10'000;
  std::size_t groups = 0, triangles = 0;
  while (!bytes.empty()) {
    std::string_view line = nextLine(bytes);
    const std::string_view word = nextWord(line);
    if (word.starts_with('g') || word.starts_with('o') || word.starts_with('u')) ++groups;
    if (word == "f") triangles += trianglesOf(line);
  }
  if (groups > kMostGroups)
    fail(name, "mesh file", fmt::format("{} materials, groups and objects", groups),
         fmt::format("at most {}", kMostGroups));
  requireTriangles(triangles, name);
}

// assimp crashes on headers that are not quite right.
void checkPly(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kFree[] = {"ply", "comment", "obj_info", ""};
  std::vector<PlyElement> elements;
  bool isText = false;
  for (;;) {
    if (bytes.empty()) fail(name, "header of the PLY file", "no 'end_header'", "one");
    const std::string_view whole = nextLine(bytes);
    std::string_view line = whole;
    const std::string_view word = nextWord(line);
    if (word == "end_header") break;
    if (word == "format") {
      isText = nextWord(line) == "ascii";
    } else if (word == "element") {
      nextWord(line);
      elements.push_back({.count = numberAt(nextWord(line))});
      requireCount(elements.back().count, name);
    } else if (word == "property" ? !readPlyProperty(line, elements)
                                  : std::find(std::begin(kFree), std::end(kFree), word) == std::end(kFree)) {
      fail(name, "header of the PLY file", fmt::format("{} bytes of an unknown line", whole.size()),
           "'element NAME COUNT', 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
  }
  if (isText) checkPlyText(bytes, elements, name);
}

// assimp keeps what it has of a text that is cut off. A binary file may begin like a text, but has the
// length that it declares.
void checkStl(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kHead = 80, kTriangle = 50;
  std::uint32_t triangles = 0;
  if (!bytes.starts_with("solid")) return;
  if (bytes.size() >= kHead + sizeof(triangles)) {
    std::memcpy(&triangles, bytes.data() + kHead, sizeof(triangles));
    if (bytes.size() == kHead + sizeof(triangles) + kTriangle * triangles) return;
  }
  while (!bytes.empty() && isSpace(bytes.back())) bytes.remove_suffix(1);
  std::string_view last = bytes.substr(bytes.rfind('\n') + 1);
  if (nextWord(last) != "endsolid") fail(name, "STL file", "no 'endsolid' at the end", "a complete file");
}

// After its counts, an OFF file has a line for each vertex, and one for each face. assimp skips words that
// are not numbers, and keeps what it has of a file that is cut off.
void checkOff(std::string_view bytes, const std::string& name) {
  std::size_t counts[3] = {}, known = 0, rows = 0;  // vertices, faces, edges
  while (!bytes.empty()) {
    std::string_view line = nextLine(bytes);
    line = line.substr(0, line.find('#'));
    const bool isCounted = known == 3;
    bool isRow = false;
    std::string_view rest = line;
    for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
      isRow = isCounted;
      if (!isNumeral(word)) {
        if (known > 0) fail(name, "OFF file", "a word that is not a number", "numbers");
      } else if (known < 3) {
        requireCount(counts[known++] = numberAt(word), name);
      }
    }
    if (isRow && rows >= counts[0] && rows < counts[0] + counts[1]) requireCorners(line, counts[0], name);
    if (isRow) ++rows;
  }
  if (rows < counts[0] + counts[1])
    fail(name, "OFF file", fmt::format("{} lines of vertices and faces", rows),
         fmt::format("{}, as its counts say", counts[0] + counts[1]));
}

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostNodesDeep = 5'000;
constexpr int kMostBrackets = 100;

struct Kind {
  const char* ending;
  std::size_t mostMiB;
};
constexpr Kind kKinds[] = {{".stl", 32},  {".obj", 16}, {".ply", 32}, {".dae", 16},
                           {".gltf", 16}, {".glb", 32}, {".off", 16}, {".msh", 32}};

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

// The value of an attribute in a tag; empty without it.
std::string_view valueOf(std::string_view tag, std::string_view attribute) {
  for (std::size_t at = tag.find(attribute); at != tag.npos; at = tag.find(attribute, at + 1)) {
    const std::size_t quote = at + attribute.size() + 1;
    if (!isSpace(tag[at - 1]) || quote >= tag.size() || tag[quote - 1] != '=') continue;
    const std::string_view rest = tag.substr(quote + 1);
    return rest.substr(0, rest.find(tag[quote]));
  }
  return {};
}

// The nodes of a Collada file, which other nodes repeat by their names: a few lines may stand for billions.
class NodeCount {
 public:
  void open(std::string_view tag) {
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    if (!open_.empty()) nodes_[open_.back()].parts.push_back(node);
    if (const std::string_view id = valueOf(tag, "id"); !id.empty()) byId_.emplace(id, node);
    open_.push_back(node);
  }
  void close() {
    if (!open_.empty()) open_.pop_back();
  }
  void repeat(std::string_view url) {
    if (open_.empty() || !url.starts_with('#')) return;
    nodes_[open_.back()].repeated.push_back(url.substr(1));
  }

  // How many nodes there are when all are repeated, at most a little more than `most`. What repeats itself
  // counts once here: assimp refuses it.
  std::size_t whole(std::size_t most) {
    for (Node& node : nodes_)
      for (const std::string_view id : node.repeated)
        if (const auto found = byId_.find(id); found != byId_.end()) node.parts.push_back(found->second);
    std::size_t largest = 0;
    for (std::size_t start = 0; start < nodes_.size(); ++start) {
      std::vector<std::size_t> path = {start};
      while (!path.empty()) {
        Node& node = nodes_[path.back()];
        node.isSeen = true;
        if (node.next < node.parts.size()) {
          if (Node& part = nodes_[node.parts[node.next]]; !part.isSeen) {
            path.push_back(node.parts[node.next]);
          } else {
            node.count = std::min(most + 1, node.count + part.count);
            ++node.next;
          }
        } else {
          largest = std::max(largest, node.count);
          path.pop_back();
        }
      }
    }
    return largest;
  }

 private:
  struct Node {
    std::vector<std::size_t> parts{};
    std::vector<std::string_view> repeated{};
    std::size_t next = 0, count = 1;
    bool isSeen = false;
  };
  std::vector<Node> nodes_;
  std::vector<std::size_t> open_;
  std::unordered_map<std::string_view, std::size_t> byId_;
};

void checkCollada(std::string_view xml, const std::string& name) {
  constexpr std::string_view kCount = "count=";
  constexpr std::size_t kMostNodes = 100'000;
  std::size_t open = 0;
  NodeCount nodes;
  for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    const std::string_view tag = xml.substr(at, xml.find('>', at) - at);
    at += tag.size();
    const std::string_view element = tag.substr(0, tag.find_first_of(" \t\r\n"));
    if (element == "<p" || element == "<vcount")
      requireIndices(xml.substr(std::min(at + 1, xml.size())), name);
    if (element == "</node") nodes.close();
    if (element == "<node" && !tag.ends_with('/')) nodes.open(tag);
    if (element == "<instance_node") nodes.repeat(valueOf(tag, "url"));
    if (tag.starts_with("</node")) open -= open > 0 ? 1 : 0;
    if (tag.starts_with("<node") && !tag.ends_with('/')) requireNodes(++open, name);
    if (const std::size_t count = tag.find(kCount); count != std::string_view::npos && count + 7 < tag.size())
      requireCount(numberAt(tag.substr(count + kCount.size() + 1)), name, 3 * kMostTriangles);
  }
  if (const std::size_t whole = nodes.whole(kMostNodes); whole > kMostNodes)
    fail(name, "mesh file", "nodes that repeat each other too often",
         fmt::format("at most {} when all are repeated", kMostNodes));
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
