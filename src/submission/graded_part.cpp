#include "submission/graded_part.h"

#include <algorithm>
#include <map>
#include <set>

#include "submission/file_pieces.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

struct NamedPiece {
  FilePiece piece;
  Names names;  // mentioned in it
  bool isFunction() const { return !piece.function.empty(); }
  bool isMain() const { return piece.function == "main"; }
};

std::vector<NamedPiece> namedPieces(std::string_view source) {
  const CppText text(source);
  std::vector<NamedPiece> named;
  for (FilePiece& piece : filePieces(text)) {
    Names names = namesIn(text, piece.first, piece.last);
    named.push_back({std::move(piece), std::move(names)});
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

// Functions with internal linkage that nothing else mentions: the compiler must see them to warn about them.
std::set<std::size_t> unused(const std::vector<NamedPiece>& pieces) {
  std::map<std::string, int, std::less<>> mentions;
  for (const NamedPiece& one : pieces)
    for (const std::string& name : one.names) ++mentions[name];
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].piece.isInternal && pieces[i].isFunction() && mentions.at(pieces[i].piece.function) == 1)
      found.insert(i);
  return found;
}

void leaveOut(std::string& text, const NamedPiece& function) {
  const bool isGone = function.piece.isInternal || function.isMain();
  const std::size_t from = isGone ? function.piece.start : function.piece.bodyStart;
  for (std::size_t at = from; at < function.piece.end; ++at)
    if (text[at] != '\n') text[at] = ' ';
  if (!isGone) text[from] = ';';
}

}  // namespace

std::string gradedPart(std::string_view source, const std::vector<std::string>& functions,
                       const std::vector<std::string>& watched) {
  const std::vector<NamedPiece> pieces = namedPieces(source);
  // Types, constants, macros and templates may call functions, too.
  Names roots(functions.begin(), functions.end());
  bool isThere = false;
  for (const NamedPiece& one : pieces) {
    if (!one.isFunction()) roots.insert(one.names.begin(), one.names.end());
    isThere = isThere || std::find(functions.begin(), functions.end(), one.piece.function) != functions.end();
  }
  if (!isThere) return {};
  std::set<std::size_t> kept = reached(pieces, roots);
  kept.merge(unused(pieces));
  std::string text(source);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool isLeftOut = pieces[i].isFunction() && !kept.contains(i);
    // A watched name in a directive or in a function that is left out could escape the scan.
    const bool couldAsk = pieces[i].piece.isDirective || (isLeftOut && !pieces[i].isMain());
    const auto isNamed = [&](const std::string& name) { return pieces[i].names.contains(name); };
    if (couldAsk && std::any_of(watched.begin(), watched.end(), isNamed)) return {};
    if (isLeftOut) leaveOut(text, pieces[i]);
  }
  return text;
}

}  // namespace rex::grading
