#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "scene/mesh_limits_internal.h"
#include "scene/mesh_text_internal.h"

namespace rex::mesh {
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

}  // namespace rex::mesh
