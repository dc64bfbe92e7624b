#include "authoring/mutants.h"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "submission/cpp_text.h"
#include "submission/graded_source.h"
#include "submission/regions.h"

namespace rex::authoring {
namespace {

using submission::TokenKind;

/// A change of the text: the characters from `start` to the one before `end` are replaced.
struct Edit {
  std::size_t start = 0, end = 0;
  std::string text{};
};
using Edits = std::vector<Edit>;

bool isOneOf(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// The tokens of a solution, with the questions that the changes ask.
class Code : public submission::CppText {
 public:
  explicit Code(std::string_view source) : CppText(source), opens_(size(), size()) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!open.empty() && i == partner(open.back())) open.pop_back();
      opens_[i] = open.empty() ? size() : open.back();
      if (isBracket(i) && partner(i) < size() && partner(i) > i) open.push_back(i);
    }
  }

  // The innermost bracket around a token; size() if there is none.
  std::size_t opens(std::size_t i) const { return opens_[i]; }
  bool isBracket(std::size_t i) const { return isSign(i, '(') || isSign(i, '[') || isSign(i, '{'); }
  std::size_t start(std::size_t i) const { return (*this)[i].start; }
  std::size_t end(std::size_t i) const { return (*this)[i].end; }
  bool touches(std::size_t i) const { return i + 1 < size() && end(i) == start(i + 1); }  // its successor

  std::string text(std::size_t first, std::size_t last) const {  // from one token to another
    return first > last ? "" : std::string(source().substr(start(first), end(last) - start(first)));
  }

  // The operator of one or two signs that begins with a token; empty if none does.
  std::string_view sign(std::size_t i) const {
    constexpr std::string_view kSigns = "+-*/<>=!&|";
    const auto isOne = [&](std::size_t k) {
      return isKind(k, TokenKind::kSign) && kSigns.find(source()[start(k)]) != kSigns.npos;
    };
    if (!isOne(i) || (i > 0 && touches(i - 1) && isOne(i - 1))) return {};
    std::size_t last = i;
    while (touches(last) && isOne(last + 1)) ++last;
    return source().substr(start(i), end(last) - start(i));
  }
  bool isBinary(std::size_t i) const {
    const std::size_t behind = i + sign(i).size();
    return i > 0 && behind < size() && behind > i && !touches(i - 1) && !touches(behind - 1);
  }
  // Whether a token is a factor or divisor: next to the operator.
  bool isBeside(std::size_t i, std::initializer_list<std::string_view> signs) const {
    return (i > 0 && isBinary(i - 1) && isOneOf(sign(i - 1), signs)) ||
           (isBinary(i + 1) && isOneOf(sign(i + 1), signs));
  }

  bool isCallOf(std::size_t i, std::initializer_list<std::string_view> names) const {
    return isName(i) && isOneOf(at(i), names) && isSign(i + 1, '(') && partner(i + 1) < size();
  }

  // Whether an operand that is one token may be whole: not if it is a name that is declared otherwise.
  bool mayBeWhole(std::size_t i) const {
    if (isKind(i, TokenKind::kNumber)) return at(i).find('.') == std::string_view::npos;
    if (!isName(i)) return isBracket(i);
    for (std::size_t k = i; k > 1; --k)
      if (at(k - 1) == at(i) && isName(k - 2))
        return isOneOf(at(k - 2), {"int", "Index", "size_t", "long", "unsigned"});
    return false;
  }

  // The semicolon that ends what a token begins; size() if a bracket closes before.
  std::size_t semicolonAfter(std::size_t i) const {
    for (; i < size() && !isSign(i, ';'); ++i) {
      if (isSign(i, ')') || isSign(i, ']') || isSign(i, '}')) return size();
      if (isBracket(i)) i = partner(i);
    }
    return i;
  }

 private:
  std::vector<std::size_t> opens_;
};

void replaceToken(const Code& code, std::size_t i, std::string_view text, Edits& edits) {
  edits.push_back({code.start(i), code.end(i), std::string(text)});
}

using Pairs = std::initializer_list<std::pair<std::string_view, std::string_view>>;

// Replaces a word by its counterpart, in both directions.
void exchange(const Code& code, std::size_t i, const Pairs& pairs, Edits& edits) {
  if (!code.isName(i)) return;
  for (const auto& [one, other] : pairs) {
    if (code.at(i) == one) replaceToken(code, i, other, edits);
    if (code.at(i) == other) replaceToken(code, i, one, edits);
  }
}

// Replaces a binary operator.
void replaceSign(const Code& code, std::size_t i, const Pairs& pairs, Edits& edits) {
  if (!code.isBinary(i)) return;
  const std::string_view sign = code.sign(i);
  for (const auto& [from, to] : pairs)
    if (sign == from) edits.push_back({code.start(i), code.start(i) + sign.size(), std::string(to)});
}

void changeSign(const Code& code, std::size_t i, Edits& edits) {
  if (code.sign(i) == "-" && !code.isBinary(i)) replaceToken(code, i, "", edits);
  if (code.at(i) != "return" || code.isSign(i + 1, '{') || code.isSign(i + 1, '-')) return;
  const std::size_t end = code.semicolonAfter(i + 1);
  if (end >= code.size() || end == i + 1) return;
  for (std::size_t k = i + 1; k < end; ++k)  // it may be true or false
    if (isOneOf(code.sign(k), {"<", "<=", ">", ">=", "==", "!=", "&&", "||", "!"}) ||
        isOneOf(code.at(k), {"true", "false"}))
      return;
  edits.push_back({code.start(i + 1), code.end(end - 1), "-(" + code.text(i + 1, end - 1) + ")"});
}

void changePlus(const Code& code, std::size_t i, Edits& edits) {
  replaceSign(code, i, {{"+", "-"}, {"-", "+"}, {"+=", "-="}, {"-=", "+="}}, edits);
}

void changeTimes(const Code& code, std::size_t i, Edits& edits) {
  replaceSign(code, i, {{"*", "/"}, {"/", "*"}, {"*=", "/="}, {"/=", "*="}}, edits);
}

void changeComparison(const Code& code, std::size_t i, Edits& edits) {
  replaceSign(code, i, {{"<", "<="}, {"<=", "<"}, {">", ">="}, {">=", ">"}, {"==", "!="}, {"!=", "=="}},
              edits);
}

// Whether [ ] picks an entry: the brackets of a lambda follow no value.
bool isIndex(const Code& code, std::size_t i) {
  return code.isSign(i, '[') && i > 0 && code.touches(i - 1) && code.partner(i) < code.size() &&
         code.partner(i) > i + 1 &&
         (code.isName(i - 1) || code.isSign(i - 1, ')') || code.isSign(i - 1, ']'));
}

void moveIndex(const Code& code, std::size_t i, std::string_view by, Edits& edits) {
  if (isIndex(code, i) && !code.isKind(i + 1, TokenKind::kNumber))
    edits.push_back({code.start(code.partner(i)), code.start(code.partner(i)), std::string(by)});
}

void changeIndex(const Code& code, std::size_t i, Edits& edits) {
  moveIndex(code, i, " + 1", edits);
  if (!code.isKind(i, TokenKind::kNumber) || (i > 0 && code.isSign(i - 1, '<') && code.touches(i - 1)) ||
      (code.isSign(i + 1, '>') && code.touches(i)))
    return;
  if (const auto number = parseNumber<long>(code.at(i)))
    replaceToken(code, i, std::to_string(*number + 1), edits);
}

void changeNext(const Code& code, std::size_t i, Edits& edits) {
  moveIndex(code, i, " - 1", edits);
  exchange(code, i, {{"front", "back"}, {"next", "previous"}}, edits);
}

void changeAxis(const Code& code, std::size_t i, Edits& edits) {
  const bool isMember = i > 0 && code.isSign(i - 1, '.');
  for (const auto& [from, to] : Pairs{{"x", "y"}, {"y", "x"}, {"z", "y"}})
    if (isMember && code.at(i) == from) replaceToken(code, i, to, edits);
  for (const auto& [from, to] : Pairs{{"UnitX", "UnitY"}, {"UnitY", "UnitX"}, {"UnitZ", "UnitY"}})
    if (code.at(i) == from) replaceToken(code, i, to, edits);
}

void changeSine(const Code& code, std::size_t i, Edits& edits) { exchange(code, i, {{"sin", "cos"}}, edits); }

void changeRow(const Code& code, std::size_t i, Edits& edits) {
  exchange(code, i, {{"row", "col"}, {"rows", "cols"}, {"rowwise", "colwise"}}, edits);
}

void dropTranspose(const Code& code, std::size_t i, Edits& edits) {
  if (!code.isCallOf(i, {"transpose", "inverse"}) || i == 0) return;
  const std::size_t close = code.partner(i + 1);
  if (code.isSign(i - 1, '.') && close == i + 2)
    edits.push_back({code.start(i - 1), code.end(close), ""});
  else if (!code.isSign(i - 1, '.') && close > i + 2)
    replaceToken(code, i, "", edits);
}

void dropFactor(const Code& code, std::size_t i, Edits& edits) {
  if (code.isBeside(i, {"*", "/"}) && isOneOf(code.at(i), {"2", "2.", "2.0", "0.5", ".5"}))
    replaceToken(code, i, code.at(i) == "2" ? "1" : "1.", edits);
}

void changeExtreme(const Code& code, std::size_t i, Edits& edits) {
  exchange(code, i, {{"min", "max"}, {"minCoeff", "maxCoeff"}, {"cwiseMin", "cwiseMax"}}, edits);
}

// Whether some tokens are a name, a number, or a part of something, without calls.
bool isPlain(const Code& code, std::size_t first, std::size_t end) {
  if (code.isSign(first, '-')) ++first;
  for (std::size_t k = first; k < end; ++k) {
    const bool isValue = code.isName(k) || code.isKind(k, TokenKind::kNumber);
    if (!isValue && !(code.isKind(k, TokenKind::kSign) && isOneOf(code.at(k), {".", ":", "[", "]"})))
      return false;
    if (isValue && k > first && (code.isName(k - 1) || code.isKind(k - 1, TokenKind::kNumber))) return false;
  }
  return first < end;
}

void swapArguments(const Code& code, std::size_t i, Edits& edits) {
  if ((!code.isSign(i, '(') && !code.isSign(i, '{')) || code.partner(i) >= code.size()) return;
  std::vector<std::size_t> ends = {i};  // the brackets, and the commas between them
  for (std::size_t k = i + 1; k < code.partner(i); ++k)
    if (code.isSign(k, ',') && code.opens(k) == i) ends.push_back(k);
  ends.push_back(code.partner(i));
  for (std::size_t n = 0; n + 2 < ends.size(); ++n) {
    const std::size_t first = ends[n] + 1, comma = ends[n + 1], end = ends[n + 2];
    if (!isPlain(code, first, comma) || !isPlain(code, comma + 1, end)) continue;
    const std::string one = code.text(first, comma - 1), other = code.text(comma + 1, end - 1);
    if (one != other) edits.push_back({code.start(first), code.end(end - 1), other + ", " + one});
  }
}

// Whether a statement can begin with a token: after another one, or in its own block.
bool startsStatement(const Code& code, std::size_t i) {
  if (i == 0 || (code.opens(i) < code.size() && !code.isSign(code.opens(i), '{'))) return false;
  if (code.isSign(i - 1, ')')) {
    const std::size_t open = code.partner(i - 1);
    return open > 0 && open < code.size() && isOneOf(code.at(open - 1), {"if", "for", "while"});
  }
  return code.isSign(i - 1, ';') || code.isSign(i - 1, '{') || code.isSign(i - 1, '}') ||
         code.at(i - 1) == "else";
}

// Whether a statement begins like "Type<...>& name" or with a keyword after which something is missed.
bool isDeclaration(const Code& code, std::size_t i) {
  if (isOneOf(code.at(i), {"const", "auto", "return", "using", "static", "constexpr", "if",      "for",
                           "while", "do",   "else",   "throw", "switch", "case",      "default", "struct",
                           "enum",  "goto", "class",  "try",   "catch",  "namespace", "template"}))
    return true;
  while (code.isName(i)) {
    if (code.isName(++i)) return true;
    if (code.isSign(i, '<') && code.touches(i - 1)) {
      int depth = 0;
      do depth += code.isSign(i, '<') - code.isSign(i, '>');
      while (++i < code.size() && depth > 0);
      if (code.isName(i)) return true;
    }
    while (code.isSign(i, ':')) ++i;
  }
  return (code.isSign(i, '&') || code.isSign(i, '*')) && code.touches(i - 1) && !code.touches(i);
}

void dropStatement(const Code& code, std::size_t i, Edits& edits) {
  if (code.isSign(i, ';') || code.isSign(i, '{') || code.isSign(i, '}') || !startsStatement(code, i)) return;
  const std::size_t end = code.semicolonAfter(i);
  if (end < code.size() && end > i && !isDeclaration(code, i))
    edits.push_back({code.start(i), code.end(end), ";"});
}

// The token that ends a branch of a ? b : c.
std::size_t branchEnd(const Code& code, std::size_t i) {
  for (int depth = 0; i < code.size(); ++i) {
    if (code.isBracket(i)) {
      i = code.partner(i);
      continue;
    }
    if (code.isSign(i, '?')) ++depth;
    const bool isColon = code.isSign(i, ':') && !code.touches(i) && !code.touches(i - 1);
    if (isColon && depth-- == 0) return i;
    if (isOneOf(code.at(i), {",", ";", ")", "]", "}"})) return i;
  }
  return code.size();
}

void negateCondition(const Code& code, std::size_t i, Edits& edits) {
  replaceSign(code, i, {{"&&", "||"}, {"||", "&&"}}, edits);
  exchange(code, i, {{"true", "false"}}, edits);
  if (code.isCallOf(i, {"if", "while"})) {
    const std::size_t open = i + 1, close = code.partner(open);
    edits.push_back({code.start(open), code.end(close), "(!" + code.text(open, close) + ")"});
  }
  if (!code.isSign(i, '?')) return;
  const std::size_t colon = branchEnd(code, i + 1);
  if (colon >= code.size() || !code.isSign(colon, ':')) return;
  const std::size_t end = branchEnd(code, colon + 1);
  if (end < code.size() && colon > i + 1 && end > colon + 1)
    edits.push_back({code.start(i + 1), code.end(end - 1),
                     code.text(colon + 1, end - 1) + " : " + code.text(i + 1, colon - 1)});
}

void takeDegrees(const Code& code, std::size_t i, Edits& edits) {
  if (code.isCallOf(i, {"sin", "cos", "tan"})) {
    const std::size_t open = i + 1, close = code.partner(open);
    if (close > open + 1)
      edits.push_back(
          {code.end(open), code.start(close), "0.0174533 * (" + code.text(open + 1, close - 1) + ")"});
  }
  if (code.isCallOf(i, {"asin", "acos", "atan", "atan2"}))
    edits.push_back({code.end(code.partner(i + 1)), code.end(code.partner(i + 1)), " * 57.2958"});
}

// Where the other operand of a quotient is whole, too: else nothing changes.
void divideWhole(const Code& code, std::size_t i, Edits& edits) {
  const auto isQuotient = [&](std::size_t first, std::size_t last) {
    return (first > 1 && code.isBinary(first - 1) && code.sign(first - 1) == "/" &&
            !code.isSign(first - 2, ')') && code.mayBeWhole(first - 2)) ||
           (code.isBinary(last + 1) && code.sign(last + 1) == "/" && code.mayBeWhole(last + 2));
  };
  const std::string_view number = code.at(i);
  const std::size_t point = number.find('.');
  if (code.isKind(i, TokenKind::kNumber) && point != number.npos && point > 0 &&
      number.find_first_not_of("0", point + 1) == number.npos && isQuotient(i, i))
    replaceToken(code, i, number.substr(0, point), edits);
  if (number != "static_cast" || code.at(i + 2) != "double" || !code.isSign(i + 4, '(')) return;
  const std::size_t close = code.partner(i + 4);
  if (close < code.size() && isQuotient(i, close)) edits.push_back({code.start(i), code.start(i + 4), ""});
}

// Not tolerances, such as 1e-9: their size is a matter of taste.
void changeConstant(const Code& code, std::size_t i, Edits& edits) {
  const std::string_view number = code.at(i);
  if (!code.isKind(i, TokenKind::kNumber) || number.find('.') == number.npos ||
      number.find("e-") != number.npos)
    return;
  const auto value = parseNumber<double>(number);
  if (!value) return;
  std::string changed = fmt::format("{:.12g}", *value == 0 ? 0.1 : 1.1 * *value);
  if (changed.find_first_of(".e") == changed.npos) changed += '.';
  replaceToken(code, i, changed, edits);
}

/// A kind of change: what it makes of the code at one token.
struct Kind {
  std::string_view name;
  void (*find)(const Code& code, std::size_t i, Edits& edits);
};

constexpr auto kKinds = std::to_array<Kind>({
    {"sign", changeSign},
    {"plus and minus", changePlus},
    {"times and over", changeTimes},
    {"comparison", changeComparison},
    {"index by one", changeIndex},
    {"previous for next", changeNext},
    {"x and y", changeAxis},
    {"sine and cosine", changeSine},
    {"row and column", changeRow},
    {"transpose or inverse dropped", dropTranspose},
    {"factor of two", dropFactor},
    {"least and most", changeExtreme},
    {"swapped arguments", swapArguments},
    {"statement dropped", dropStatement},
    {"condition negated", negateCondition},
    {"degrees", takeDegrees},
    {"integer division", divideWhole},
    {"constant by a tenth", changeConstant},
});

// The text in one line, with single blanks.
std::string inOneLine(std::string_view text) {
  std::vector<std::string_view> words;
  for (const std::string_view line : splitLines(text))
    for (const std::string_view word : splitWords(line)) words.push_back(word);
  return join(words, " ");
}

// Those of the lines that are wanted.
std::vector<Mutant> mutantsWhere(std::string_view source, const std::function<bool(int)>& isWanted) {
  const std::string open = withoutUnnamedNamespaces(source);
  const Code code(open);
  const submission::TextPlaces places(open);
  std::vector<Mutant> mutants;
  std::set<std::tuple<std::size_t, std::size_t, std::string>> seen;
  const auto add = [&](const Kind& kind, std::string_view function, Edit edit) {
    if (!seen.emplace(edit.start, edit.end, edit.text).second) return;
    const std::size_t first = edit.start == 0 ? 0 : open.rfind('\n', edit.start - 1) + 1;
    const std::size_t last = std::min(open.find('\n', edit.end), open.size());
    std::string before = open.substr(first, last - first);
    const auto [line, column] = places.place(edit.start);
    mutants.push_back(
        {.change = std::string(kind.name),
         .function = std::string(function),
         .line = line,
         .column = column,
         .before = inOneLine(before),
         .after = inOneLine(before.replace(edit.start - first, edit.end - edit.start, edit.text)),
         .start = edit.start,
         .end = edit.end,
         .replacement = edit.text});
  };
  for (const submission::CppPiece& piece : submission::cppPieces(code)) {
    if (piece.function.empty() || piece.isInternal || piece.function == "main") continue;
    for (std::size_t i = piece.first; i < piece.last; ++i) {
      if (code.start(i) <= piece.bodyStart || !isWanted(places.line(code.start(i)))) continue;
      for (const Kind& kind : kKinds) {
        Edits edits;
        kind.find(code, i, edits);
        for (Edit& edit : edits) add(kind, piece.function, std::move(edit));
      }
    }
  }
  return mutants;
}

}  // namespace

std::vector<std::string> kindsOfChanges() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

std::string mutated(std::string_view solution, const Mutant& mutant) {
  return std::string(solution).replace(mutant.start, mutant.end - mutant.start, mutant.replacement);
}

std::string withoutUnnamedNamespaces(std::string_view source) {
  const submission::CppText text(source);
  std::string open(source);
  const auto blank = [&](std::size_t i) {
    std::fill_n(open.begin() + text[i].start, text[i].end - text[i].start, ' ');
  };
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text.at(i) != "namespace" || !text.isSign(i + 1, '{') || text.partner(i + 1) >= text.size()) continue;
    for (const std::size_t k : {i, i + 1, text.partner(i + 1)}) blank(k);
  }
  return open;
}

std::vector<Mutant> mutantsOf(std::string_view solution, const std::string& file) {
  std::set<int> lines;  // of the regions
  for (const auto& block : submission::solutionBlocks(solution, file))
    for (const submission::BlockLine& line : block) lines.insert(line.number);
  return mutantsWhere(solution, [&](int line) { return lines.contains(line); });
}

std::vector<Mutant> mutantsOfFile(std::string_view source) {
  return mutantsWhere(source, [](int) { return true; });
}

}  // namespace rex::authoring
