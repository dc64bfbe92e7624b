#include "submission/file_pieces.h"

#include <algorithm>
#include <array>

namespace rex::grading {
namespace {

// Words before the body of anything but a function, of a function whose body its callers may inspect, and of
// one that has other parentheses before its parameters.
constexpr auto kOtherWords = std::to_array<std::string_view>(
    {"__attribute__", "alignas",  "auto",   "class",   "concept",   "consteval", "constexpr", "decltype",
     "enum",          "explicit", "extern", "inline",  "namespace", "operator",  "requires",  "static",
     "struct",        "template", "try",    "typedef", "union",     "using"});

// By how much a token changes the number of open brackets.
int opening(const CppText& text, std::size_t i) {
  const auto isOneOf = [&](std::string_view signs) {
    return text.isKind(i, TokenKind::kSign) && signs.find(text.at(i).front()) != signs.npos;
  };
  return isOneOf("([{") ? 1 : isOneOf(")]}") ? -1 : 0;
}

// The token after the ';' or '}' that ends the piece that starts at `i`.
std::size_t behindPiece(const CppText& text, std::size_t i) {
  int depth = 0;
  for (; i < text.size(); ++i) {
    depth += opening(text, i);
    if (depth > 0) continue;
    if (text.isSign(i, ';')) return i + 1;
    // Classes and initialisers continue after their braces.
    const std::string_view next = text.at(i + 1);
    if (text.isSign(i, '}') && (next.empty() || std::string_view(";,.{").find(next) == next.npos))
      return i + 1;
  }
  return text.size();
}

// The first such bracket outside all other brackets among these tokens, or `end`.
std::size_t outerBracket(const CppText& text, std::size_t first, std::size_t end, char bracket) {
  int depth = 0;
  for (std::size_t i = first; i < end; ++i) {
    if (depth == 0 && text.isSign(i, bracket)) return i;
    depth += opening(text, i);
  }
  return end;
}

bool hasOtherWord(const CppText& text, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i)
    if (text.isName(i) && std::ranges::binary_search(kOtherWords, text.at(i))) return true;
  return false;
}

// The token with the name in "type name(parameters) {", of which the brace is at `end`; `end` if it is
// something else.
std::size_t functionName(const CppText& text, std::size_t first, std::size_t end) {
  const std::size_t open = outerBracket(text, first, end, '(');
  if (open == end || open < first + 2 || hasOtherWord(text, first, end)) return end;
  const bool isMember = text.isSign(open - 2, ':') || text.isSign(open - 2, '~');
  return text.isName(open - 1) && !isMember ? open - 1 : end;
}

bool opensNamelessNamespace(const CppText& text, std::size_t i) {
  return text.isName(i) && text.at(i) == "namespace" && text.isSign(i + 1, '{');
}

FilePiece pieceAt(const CppText& text, std::size_t i) {
  FilePiece piece{.start = text[i].start, .first = i};
  piece.isDirective = text.isSign(i, '#');
  piece.last = piece.isDirective                 ? text.nextLine(i)
               : opensNamelessNamespace(text, i) ? i + 2
                                                 : behindPiece(text, i);
  piece.end = text[piece.last - 1].end;
  const std::size_t body = outerBracket(text, i, piece.last, '{');
  if (piece.isDirective || !text.isSign(piece.last - 1, '}') || body == piece.last) return piece;
  const std::size_t name = functionName(text, i, body);
  if (name == body) return piece;
  piece.function = text.at(name);
  piece.nameStart = text[name].start;
  piece.bodyStart = text[body].start;
  return piece;
}

}  // namespace

std::vector<FilePiece> filePieces(const CppText& text) {
  std::vector<FilePiece> pieces;
  int open = 0;  // unnamed namespaces
  for (std::size_t i = 0; i < text.size(); i = pieces.back().last) {
    FilePiece piece = pieceAt(text, i);
    const bool closes = piece.last == i + 1 && text.isSign(i, '}') && open > 0;
    if (closes) --open;
    piece.isInternal = open > 0;
    if (opensNamelessNamespace(text, i)) ++open;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace rex::grading
