#include "submission/source_shares.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "submission/file_pieces.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

using Names = std::set<std::string, std::less<>>;
constexpr std::string_view kBlanks = " \t\r\n";

Names namesIn(std::string_view code) {
  Names names;
  for (std::size_t at = 0; at < code.size(); ++at) {
    const std::size_t start = at;
    while (at < code.size() && isWord(code[at])) ++at;
    if (at > start) names.emplace(code.substr(start, at - start));
  }
  return names;
}

std::string_view firstWord(std::string_view code) {
  const auto end = std::find_if_not(code.begin(), code.end(), isWord);
  return code.substr(0, static_cast<std::size_t>(end - code.begin()));
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// "type name(parameters);" and nothing else, of one of these functions.
bool declaresOneOf(std::string_view code, const Names& functions) {
  const std::size_t open = code.find('(');
  if (open == code.npos || code.find('=') != code.npos) return false;
  int depth = 0;
  std::size_t close = open;
  for (; close < code.size(); ++close) {
    depth += (code[close] == '(') - (code[close] == ')');
    if (depth == 0) break;
  }
  if (code.find_first_not_of(kBlanks, close + 1) + 1 != code.size()) return false;
  const Names names = namesIn(code.substr(0, open));
  return std::any_of(names.begin(), names.end(), [&](const auto& name) { return functions.contains(name); });
}

// What a declaration says before a value begins.
std::string_view declarator(std::string_view code) { return code.substr(0, code.find_first_of("=({")); }

// Whether a piece that is no plain function may stand in two objects of one program: types, templates,
// constants and what the preprocessor reads.
bool mayBeThereTwice(std::string_view code, const Names& functions) {
  if (code.front() == '#' || code == "}" || code.back() == '{' || code == ";") return true;
  const Names words = namesIn(code);
  if (words.contains("static") || words.contains("thread_local") || words.contains("extern")) return false;
  const std::string_view first = firstWord(code);
  if (isOneOf(first, {"using", "typedef", "static_assert", "constexpr", "concept"})) return true;
  if (first == "template") return code.find('<') != code.find("<>");
  if (first == "const") return declarator(code).find('*') == code.npos;
  if (first == "inline") return code.back() == '}';
  // Without an object behind the braces.
  if (isOneOf(first, {"struct", "class", "enum", "union"})) {
    const std::size_t last = code.find_last_not_of("; \t\r\n");
    return code.back() == ';' && (code.find('{') == code.npos || code[last] == '}');
  }
  return code.back() == ';' && declaresOneOf(code, functions);
}

class Division {
 public:
  Division(std::string_view source, const std::vector<std::string>& graded)
      : source_(source), code_(codeOf(source)), pieces_(filePieces(source)) {
    for (const FilePiece& piece : pieces_)
      if (!piece.function.empty()) functions_.insert(piece.function);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (!isFunction(i)) fixed_.merge(namesIn(codeOfPiece(i)));
    Names roots = fixed_;
    roots.insert(graded.begin(), graded.end());
    for (const std::size_t i : reached(std::move(roots), true))
      if (!pieces_[i].isInternal) shared_.push_back(i);
  }

  // The graded functions, and others that they call.
  const std::vector<std::size_t>& shared() const { return shared_; }

  bool canBeSeveral() const {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!isFunction(i) && !mayBeThereTwice(codeOfPiece(i), functions_)) return false;
      if (isFunction(i) && pieces_[i].isInternal && namesIn(codeOfPiece(i)).contains("static")) return false;
    }
    return true;
  }

  std::size_t size(std::size_t i) const { return pieces_[i].end - pieces_[i].start; }

  // The file with the bodies of these functions, and of internal ones that they need.
  std::string text(const std::set<std::size_t>& bodies) const {
    Names needed = fixed_;
    for (const std::size_t i : bodies) needed.merge(namesIn(codeOfPiece(i)));
    const std::set<std::size_t> kept = reached(std::move(needed), false);
    std::string text(source_);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!isFunction(i) || bodies.contains(i) || kept.contains(i)) continue;
      const bool isGone = pieces_[i].isInternal || pieces_[i].function == "main";
      const std::size_t from = isGone ? pieces_[i].start : pieces_[i].bodyStart;
      for (std::size_t at = from; at < pieces_[i].end; ++at)
        if (text[at] != '\n') text[at] = ' ';
      if (!isGone) text[from] = ';';
    }
    return text;
  }

 private:
  bool isFunction(std::size_t i) const { return !pieces_[i].function.empty(); }
  std::string_view codeOfPiece(std::size_t i) const {
    return std::string_view(code_).substr(pieces_[i].start, size(i));
  }

  // The functions of these names, and all that they mention in turn; others than internal ones only if asked
  // for.
  std::set<std::size_t> reached(Names names, bool all) const {
    std::set<std::size_t> found;
    for (bool isNew = true; isNew;) {
      isNew = false;
      for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const std::string& function = pieces_[i].function;
        if (function.empty() || function == "main" || !(all || pieces_[i].isInternal)) continue;
        if (!names.contains(function) || !found.insert(i).second) continue;
        names.merge(namesIn(codeOfPiece(i)));
        isNew = true;
      }
    }
    return found;
  }

  std::string_view source_;
  std::string code_;
  std::vector<FilePiece> pieces_;
  Names functions_;  // all plain ones
  Names fixed_;      // named outside of them
  std::vector<std::size_t> shared_;
};

}  // namespace

std::vector<std::string> sourceShares(std::string_view source, const std::vector<std::string>& functions,
                                      int most) {
  const Division division(source, functions);
  std::vector<std::size_t> order = division.shared();
  if (order.empty() || most < 1) return {};
  const std::size_t count =
      division.canBeSeveral() ? std::min(static_cast<std::size_t>(most), order.size()) : 1;
  // The longest first, each to the share with the least so far.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return division.size(a) > division.size(b); });
  std::vector<std::set<std::size_t>> bodies(count);
  std::vector<std::size_t> sizes(count, 0);
  for (const std::size_t i : order) {
    const auto least = static_cast<std::size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
    bodies[least].insert(i);
    sizes[least] += division.size(i);
  }
  std::vector<std::string> texts;
  for (const std::set<std::size_t>& some : bodies) texts.push_back(division.text(some));
  return texts;
}

}  // namespace rex::grading
