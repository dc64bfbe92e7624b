#include "submission/file_pieces.h"

#include <algorithm>
#include <array>

#include "submission/mentions.h"

namespace rex::grading {
namespace {

constexpr std::string_view kNoCode = " \t\r\n";

// Words before the body of anything but a function, of a function whose body its callers may inspect, and of
// one that has other parentheses before its parameters.
constexpr auto kOtherWords = std::to_array<std::string_view>(
    {"__attribute__", "alignas",  "auto",   "class",   "concept",   "consteval", "constexpr", "decltype",
     "enum",          "explicit", "extern", "inline",  "namespace", "operator",  "requires",  "static",
     "struct",        "template", "try",    "typedef", "union",     "using"});

// The position after a preprocessor directive, which a backslash continues on the next line.
std::size_t behindDirective(const std::string& code, std::size_t at) {
  std::size_t end = code.find('\n', at);
  while (end != code.npos && code[end - 1] == '\\') end = code.find('\n', end + 1);
  return std::min(end, code.size());
}

// The position after the ';' or '}' that ends the piece that starts at `at`.
std::size_t behindPiece(const std::string& code, std::size_t at) {
  int depth = 0;
  for (; at < code.size(); ++at) {
    const char c = code[at];
    depth += (c == '(' || c == '[' || c == '{') - (c == ')' || c == ']' || c == '}');
    if (depth > 0) continue;
    if (c == ';') return at + 1;
    const std::size_t next = c == '}' ? code.find_first_not_of(kNoCode, at + 1) : 0;
    // Classes and initialisers continue after their braces.
    if (c == '}' && (next == code.npos || std::string_view(";,.{").find(code[next]) == code.npos))
      return at + 1;
  }
  return code.size();
}

// The first such bracket outside all other brackets, or npos.
std::size_t outerBracket(std::string_view code, char bracket) {
  int depth = 0;
  for (std::size_t at = 0; at < code.size(); ++at) {
    const char c = code[at];
    if (c == bracket && depth == 0) return at;
    depth += (c == '(' || c == '[' || c == '{') - (c == ')' || c == ']' || c == '}');
  }
  return code.npos;
}

bool hasOtherWord(std::string_view head) {
  for (std::size_t at = 0; at < head.size(); ++at) {
    const std::size_t start = at;
    while (at < head.size() && isWord(head[at])) ++at;
    if (std::ranges::binary_search(kOtherWords, head.substr(start, at - start))) return true;
  }
  return false;
}

// The name in "type name(parameters) {", a part of `head`; empty if `head` is something else.
std::string_view functionName(std::string_view head) {
  const std::size_t open = outerBracket(head, '(');
  if (open == head.npos || hasOtherWord(head)) return {};
  head = head.substr(0, open);
  const std::size_t last = head.find_last_not_of(kNoCode);
  if (last == head.npos) return {};
  std::size_t first = last + 1;
  while (first > 0 && isWord(head[first - 1])) --first;
  const std::size_t before = head.substr(0, first).find_last_not_of(kNoCode);
  if (before == head.npos || head[before] == ':' || head[before] == '~') return {};
  return head.substr(first, last + 1 - first);
}

// The position after the brace that opens an unnamed namespace at `at`, or npos.
std::size_t behindNamelessNamespace(std::string_view code, std::size_t at) {
  constexpr std::string_view kWord = "namespace";
  if (code.substr(at, kWord.size()) != kWord) return code.npos;
  const std::size_t brace = code.find_first_not_of(kNoCode, at + kWord.size());
  return brace != code.npos && code[brace] == '{' ? brace + 1 : code.npos;
}

std::size_t behindAnyPiece(const std::string& code, std::size_t at) {
  if (code[at] == '#') return behindDirective(code, at);
  const std::size_t opened = behindNamelessNamespace(code, at);
  return opened != code.npos ? opened : behindPiece(code, at);
}

}  // namespace

std::vector<FilePiece> filePieces(std::string_view source) {
  const std::string code = codeOf(source);
  std::vector<FilePiece> pieces;
  int open = 0;  // unnamed namespaces
  for (std::size_t at = code.find_first_not_of(kNoCode); at != code.npos;
       at = code.find_first_not_of(kNoCode, pieces.back().end)) {
    FilePiece piece{.start = at, .end = behindAnyPiece(code, at), .isInternal = open > 0};
    const std::string_view text = std::string_view(code).substr(at, piece.end - at);
    const std::size_t body = outerBracket(text, '{');
    if (text.front() != '#' && text.back() == '}' && body != text.npos) {
      const std::string_view name = functionName(text.substr(0, body));
      piece.function = name;
      if (!name.empty()) {
        piece.nameStart = at + static_cast<std::size_t>(name.data() - text.data());
        piece.bodyStart = at + body;
      }
    }
    if (behindNamelessNamespace(code, at) != code.npos) ++open;
    if (text == "}" && open > 0) piece.isInternal = --open > 0;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace rex::grading
