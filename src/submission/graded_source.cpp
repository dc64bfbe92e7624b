#include "submission/graded_source.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "submission/cpp_names.h"

namespace rex::submission {
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

CppPiece pieceAt(const CppText& text, std::size_t i) {
  CppPiece piece{.start = text[i].start, .first = i};
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

std::vector<CppPiece> cppPieces(const CppText& text) {
  std::vector<CppPiece> pieces;
  int open = 0;  // unnamed namespaces
  for (std::size_t i = 0; i < text.size(); i = pieces.back().last) {
    CppPiece piece = pieceAt(text, i);
    const bool closes = piece.last == i + 1 && text.isSign(i, '}') && open > 0;
    if (closes) --open;
    piece.isInternal = open > 0;
    if (opensNamelessNamespace(text, i)) ++open;
    pieces.push_back(piece);
  }
  return pieces;
}

namespace {

struct NamedPiece {
  CppPiece piece;
  Names names;          // mentioned in it
  std::size_t gap = 0;  // a position on an earlier line, from where only comments follow; 0 if there is none
  bool isFunction() const { return !piece.function.empty(); }
  bool isMain() const { return piece.function == "main"; }
};

std::size_t gapBefore(const CppPiece& piece, const CppPiece& last, const CppText& text) {
  const std::string_view source = text.source();
  const std::size_t gap = last.isDirective ? source.find('\n', last.end) + 1 : last.end;
  // A name, as attributes come before words that are put there.
  const bool isFree = text.isName(piece.first) && gap < piece.start;
  return isFree && source.substr(gap, piece.start - gap).find('\n') != source.npos ? gap : 0;
}

// Without pieces that name nothing, such as a ';' alone: a file may have a million of them.
std::vector<NamedPiece> namedPieces(const CppText& text) {
  std::vector<NamedPiece> named;
  const std::vector<CppPiece> pieces = cppPieces(text);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Names names = namesIn(text, pieces[i].first, pieces[i].last);
    if (names.empty()) continue;
    named.push_back({pieces[i], std::move(names), i > 0 ? gapBefore(pieces[i], pieces[i - 1], text) : 0});
  }
  return named;
}

// The functions of these names, and all that they mention in turn.
std::set<std::size_t> reached(const std::vector<NamedPiece>& pieces, const Names& names) {
  std::multimap<std::string_view, std::size_t> functions;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].isFunction() && !pieces[i].isMain()) functions.emplace(pieces[i].piece.function, i);
  std::set<std::size_t> found;
  std::vector<std::size_t> open;  // found, but what they mention is not
  const auto visit = [&](const Names& mentioned) {
    for (const std::string& name : mentioned) {
      const auto [first, end] = functions.equal_range(name);
      for (auto one = first; one != end; ++one) {
        found.insert(one->second);
        open.push_back(one->second);
      }
      functions.erase(first, end);
    }
  };
  visit(names);
  while (!open.empty()) {
    const std::size_t next = open.back();
    open.pop_back();
    visit(pieces[next].names);
  }
  return found;
}

// Compilers make no code of an inline function that nothing calls. main() cannot be inline, one in a
// namespace can.
void leaveOut(const NamedPiece& function, std::string_view source, std::size_t& done, std::string& text) {
  if (function.piece.isInternal || function.gap == 0) return;  // nothing that remains calls it
  text.append(source.substr(done, function.gap - done));
  text.append(function.isMain() ? " namespace rexLeftOut { inline " : " inline ");
  done = function.piece.end - (function.isMain() ? 1 : 0);
  text.append(source.substr(function.gap, done - function.gap));
  if (!function.isMain()) return;
  text.append(";return 0;}}");  // the first ';' ends no statement that a warning may be about
  ++done;
}

}  // namespace

std::string gradedSource(std::string_view source, const std::vector<std::string>& functions,
                         const std::vector<std::string>& watched) {
  const CppText tokens(source);
  const std::vector<NamedPiece> pieces = namedPieces(tokens);
  // Types, constants, macros and templates may call functions, too.
  Names roots(functions.begin(), functions.end());
  bool isThere = false;
  for (const NamedPiece& one : pieces) {
    if (!one.isFunction()) roots.insert(one.names.begin(), one.names.end());
    isThere = isThere || std::find(functions.begin(), functions.end(), one.piece.function) != functions.end();
  }
  if (!isThere) return {};
  const std::set<std::size_t> kept = reached(pieces, roots);
  std::string text;
  std::size_t done = 0, leftOut = 0;  // characters
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool isLeftOut = pieces[i].isFunction() && !kept.contains(i);
    // A watched name in a directive or in a function that is left out could escape the scan.
    const bool couldAsk = pieces[i].piece.isDirective || (isLeftOut && !pieces[i].isMain());
    const auto isNamed = [&](const std::string& name) { return pieces[i].names.contains(name); };
    if (couldAsk && std::any_of(watched.begin(), watched.end(), isNamed)) return {};
    if (!isLeftOut) continue;
    leaveOut(pieces[i], source, done, text);
    leftOut += pieces[i].piece.end - pieces[i].piece.start;
  }
  constexpr std::size_t kMuch = 300;
  return leftOut > kMuch ? text.append(source.substr(done)) : std::string(source);
}

}  // namespace rex::submission
