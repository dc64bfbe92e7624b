#include "authoring/shown_code.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "submission/cpp_names.h"
#include "submission/cpp_text.h"
#include "submission/graded_source.h"

namespace rex::authoring {
namespace {

using submission::CppPiece;
using submission::CppText;
using submission::TokenKind;

// Source of the same length without what keeps cppPieces() from seeing functions: named namespaces,
// attributes and words such as `inline`.
std::string flattened(std::string_view source) {
  constexpr std::array<std::string_view, 3> kWords = {"inline", "static", "constexpr"};
  const CppText text(source);
  std::string flat(source);
  const auto blank = [&](std::size_t first, std::size_t last) {
    std::fill(flat.begin() + text[first].start, flat.begin() + text[last].end, ' ');
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.isName(i) && std::find(kWords.begin(), kWords.end(), text.at(i)) != kWords.end()) blank(i, i);
    // So that it counts as a type: whatever it is.
    if (text.isName(i) && text.at(i) == "auto" && text.isName(i + 1) && text.isSign(i + 2, '('))
      flat[text[i].start] = 'A';
    if (text.isSign(i, '[') && text.isSign(i + 1, '[') && text.partner(i) < text.size())
      blank(i, text.partner(i));
    if (!text.isName(i) || text.at(i) != "namespace" || !text.isName(i + 1)) continue;
    std::size_t open = i + 1;
    while (text.isName(open) || text.isSign(open, ':')) ++open;
    if (!text.isSign(open, '{') || text.partner(open) >= text.size()) continue;
    blank(i, open);
    blank(text.partner(open), text.partner(open));
  }
  return flat;
}

// The type that these tokens spell, without what does not matter for fits(); empty if it is not said.
std::string typeOf(const CppText& text, std::size_t first, std::size_t end) {
  constexpr std::array<std::string_view, 9> kIgnored = {"const",    "std", "rex",       "Eigen",   "typename",
                                                        "volatile", "Ref", "constexpr", "unsigned"};
  std::string type;
  for (std::size_t i = first; i < end; ++i) {
    const std::string_view word = text.at(i);
    if (word == "auto" || word == "Auto") return {};
    if (std::find(kIgnored.begin(), kIgnored.end(), word) == kIgnored.end() && word != ":" && word != "&")
      type += word;
  }
  // What is left of Ref<const VectorXd>.
  if (type.starts_with('<') && type.ends_with('>')) type = type.substr(1, type.size() - 2);
  return type;
}

int nesting(const CppText& text, std::size_t i) {
  if (!text.isKind(i, TokenKind::kSign)) return 0;
  const char sign = text.at(i).front();
  if (sign == '>' && i > 0 && text.isSign(i - 1, '-')) return 0;
  return std::string_view("([{<").find(sign) != std::string_view::npos   ? 1
         : std::string_view(")]}>").find(sign) != std::string_view::npos ? -1
                                                                         : 0;
}

ShownParameter parameterIn(const CppText& text, std::size_t first, std::size_t end) {
  ShownParameter parameter;
  std::size_t stop = first;
  for (int depth = 0; stop < end; ++stop) {
    depth += nesting(text, stop);
    if (depth == 0 && text.isSign(stop, '=')) break;
  }
  parameter.isOptional = stop < end;
  if (stop > first + 1 && text.isName(stop - 1)) parameter.name = text.at(--stop);
  parameter.type = typeOf(text, first, stop);
  bool isConst = false, isReference = false;
  for (std::size_t i = first; i < stop; ++i) {
    isConst = isConst || text.at(i) == "const";
    isReference = isReference || text.isSign(i, '&');
  }
  parameter.isMutable = isReference && !isConst;
  return parameter;
}

// The parameters between these parentheses.
std::vector<ShownParameter> parametersIn(const CppText& text, std::size_t open, std::size_t close) {
  std::vector<ShownParameter> parameters;
  int depth = 0;
  std::size_t first = open + 1;
  for (std::size_t i = open + 1; i <= close; ++i) {
    if (i < close && !(depth == 0 && text.isSign(i, ','))) {
      depth += nesting(text, i);
      continue;
    }
    if (i > first) parameters.push_back(parameterIn(text, first, i));
    first = i + 1;
  }
  return parameters;
}

std::size_t tokenAt(const CppText& text, const CppPiece& piece, std::size_t position) {
  std::size_t i = piece.first;
  while (i < piece.last && text[i].start < position) ++i;
  return i;
}

ShownCode functionOf(const CppText& flat, std::string_view source, const CppPiece& piece) {
  const std::size_t name = tokenAt(flat, piece, piece.nameStart);
  ShownCode code{.name = std::string(piece.function), .result = typeOf(flat, piece.first, name)};
  code.parameters = parametersIn(flat, name + 1, flat.partner(name + 1));
  code.text = source.substr(piece.start, piece.end - piece.start);
  code.start = piece.start;
  code.body = piece.bodyStart;
  const std::size_t open = flat[name + 1].start;
  code.lambda = "[&]" + std::string(source.substr(open, piece.bodyStart - open));
  if (!code.result.empty())
    code.lambda += "-> " + std::string(flat.source().substr(piece.start, piece.nameStart - piece.start));
  code.lambda += source.substr(piece.bodyStart, piece.end - piece.bodyStart);
  return code;
}

// The lambda of `name = [](...) {...}` whose name is token `i`; nothing if there is none.
std::optional<ShownCode> lambdaAt(const CppText& text, std::size_t i) {
  if (!text.isName(i) || !text.isSign(i + 1, '=') || !text.isSign(i + 2, '[') || !text.isSign(i + 3, ']'))
    return {};
  const std::size_t open = i + 4;
  if (!text.isSign(open, '(')) return {};
  const std::size_t close = text.partner(open);
  std::size_t body = close;
  while (body < text.size() && !text.isSign(body, '{') && !text.isSign(body, ';')) ++body;
  if (!text.isSign(body, '{') || text.partner(body) >= text.size()) return {};
  ShownCode code{.name = std::string(text.at(i)), .isLambda = true};
  code.parameters = parametersIn(text, open, close);
  code.start = text[i].start;
  code.body = text[body].start;
  const std::size_t end = text[text.partner(body)].end;
  code.text = text.source().substr(code.start, end - code.start);
  code.lambda = "[&]" + std::string(text.source().substr(text[open].start, end - text[open].start));
  return code;
}

/// Finds the expressions of one piece.
class Expressions {
 public:
  Expressions(const CppText& text, const CppPiece& piece, const ShownCode* function)
      : text_(text), piece_(piece), function_(function) {}

  std::vector<ShownCode> find() const {
    std::vector<ShownCode> found;
    for (std::size_t i = piece_.first; i < piece_.last; ++i) {
      const bool returns = text_.isName(i) && text_.at(i) == "return";
      if (!returns && !isAssignment(i)) continue;
      std::size_t end = i + 1;
      // A comma at the end of the first of several variables ends it, too, and it is left out.
      for (int depth = 0; end < piece_.last && !(depth == 0 && endsHere(end)); ++end) {
        depth += bracket(end);
        if (depth < 0) break;
      }
      if (!text_.isSign(end, ';') || !hasLines(i + 1, end)) continue;
      if (std::optional<ShownCode> one = expression(i, end, returns)) found.push_back(std::move(*one));
    }
    return found;
  }

 private:
  int bracket(std::size_t i) const {
    return text_.isSign(i, '<') || text_.isSign(i, '>') ? 0 : nesting(text_, i);
  }
  // One that initialises a variable.
  bool isAssignment(std::size_t i) const {
    return text_.isSign(i, '=') && !text_.isSign(i + 1, '=') && i > piece_.first + 1 && text_.isName(i - 1) &&
           (text_.isName(i - 2) || text_.isSign(i - 2, '&') || text_.isSign(i - 2, '>'));
  }
  bool endsHere(std::size_t i) const { return text_.isSign(i, ';') || text_.isSign(i, ','); }
  bool hasLines(std::size_t first, std::size_t end) const {
    const std::size_t start = text_[first].start, size = text_[end].start - start;
    return text_.source().substr(start, size).find('\n') != std::string_view::npos;
  }

  std::optional<ShownCode> expression(std::size_t before, std::size_t end, bool returns) const {
    if (text_.isSign(before + 1, '{') || text_.isSign(before + 1, '[')) return {};
    ShownCode code;
    code.start = text_[before + 1].start;
    code.text = text_.source().substr(code.start, text_[end].start - code.start);
    if (returns && function_ != nullptr && !isInLambda(before)) code.result = function_->result;
    if (!returns) code.result = typeBefore(before - 1).value_or("");
    std::set<std::string_view> seen;
    for (std::size_t i = before + 1; i < end; ++i) {
      if (!isVariable(i) || !seen.insert(text_.at(i)).second) continue;
      const std::optional<std::string> type = declared(text_.at(i), before, end);
      if (!type) continue;
      if (type->empty()) return {};
      code.parameters.push_back({.type = *type, .name = std::string(text_.at(i))});
    }
    if (code.result.empty() && code.parameters.empty()) return {};
    return code;
  }

  bool isInLambda(std::size_t i) const {
    for (std::size_t k = piece_.first; k < i; ++k)
      if (text_.isSign(k, '[') && k > 0 && !text_.isName(k - 1) && !text_.isSign(k - 1, ')') &&
          !text_.isSign(k - 1, ']')) {
        std::size_t open = text_.partner(k) + 1;
        while (open < i && !text_.isSign(open, '{') && !text_.isSign(open, ';')) ++open;
        if (text_.isSign(open, '{') && text_.partner(open) > i) return true;
      }
    return false;
  }

  bool isVariable(std::size_t i) const {
    const bool isMember = i > 0 && (text_.isSign(i - 1, '.') || text_.isSign(i - 1, ':') ||
                                    (text_.isSign(i - 1, '>') && i > 1 && text_.isSign(i - 2, '-')));
    return text_.isName(i) && !isMember && !text_.isSign(i + 1, ':');
  }

  // The type of a name that the function declares before the expression; empty if it is not said. Nothing for
  // names that it does not declare there, or that the expression declares itself.
  std::optional<std::string> declared(std::string_view name, std::size_t before, std::size_t end) const {
    for (std::size_t i = before + 1; i < end; ++i)
      if (text_.at(i) == name && typeBefore(i)) return {};
    if (function_ == nullptr) return {};
    for (std::size_t i = before; i-- > piece_.first;)
      if (text_.at(i) == name)
        if (const std::optional<std::string> type = typeBefore(i)) return type;
    for (const ShownParameter& parameter : function_->parameters)
      if (parameter.name == name) return parameter.type;
    // As in `double c = 1, s = 0;` or `const auto [a, b] = ...`.
    for (std::size_t i = before; i-- > piece_.first;)
      if (text_.at(i) == name && (text_.isSign(i - 1, ',') || text_.isSign(i - 1, '[')) && isVariable(i))
        return std::string();
    return {};
  }

  // The type in front of the name `i` if it is declared there.
  std::optional<std::string> typeBefore(std::size_t i) const {
    constexpr std::string_view kBehind = "=;{,):(";
    if (!text_.isName(i) || !text_.isKind(i + 1, TokenKind::kSign) ||
        kBehind.find(text_.at(i + 1)) == std::string_view::npos)
      return {};
    std::size_t first = i;
    for (int depth = 0; first > piece_.first; --first) {
      const std::size_t k = first - 1;
      if (text_.isSign(k, '>')) ++depth;
      if (text_.isSign(k, '<')) --depth;
      const bool isOfType = text_.isName(k) || text_.isSign(k, ':') || text_.isSign(k, '&') ||
                            text_.isSign(k, '*') || text_.isSign(k, '<') || text_.isSign(k, '>');
      if (depth <= 0 && !isOfType) break;
    }
    constexpr std::array<std::string_view, 6> kNoTypes = {"return", "else", "case", "throw", "new", "delete"};
    if (first == i || std::find(kNoTypes.begin(), kNoTypes.end(), text_.at(first)) != kNoTypes.end())
      return {};
    return typeOf(text_, first, i);
  }

  const CppText& text_;
  const CppPiece& piece_;
  const ShownCode* function_;
};

bool isNumber(std::string_view type) {
  constexpr std::array<std::string_view, 8> kNumbers = {"double", "float", "int",    "long",
                                                        "Index",  "short", "size_t", "int64_t"};
  return std::find(kNumbers.begin(), kNumbers.end(), type) != kNumbers.end();
}

// "Vector3d" is a vector of size "3".
struct Dense {
  std::string_view kind, size;
};

std::optional<Dense> denseOf(std::string_view type) {
  for (const std::string_view kind : {"Vector", "Matrix", "RowVector"})
    if (type.starts_with(kind) && type.ends_with('d'))
      return Dense{kind, type.substr(kind.size(), type.size() - kind.size() - 1)};
  return {};
}

}  // namespace

std::vector<ShownCode> functionsIn(std::string_view source) {
  const std::string text = flattened(source);
  const CppText flat(text);
  std::vector<ShownCode> functions;
  for (const CppPiece& piece : submission::cppPieces(flat))
    if (!piece.function.empty() && piece.function != "main")
      functions.push_back(functionOf(flat, source, piece));
  const CppText tokens(source);
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (std::optional<ShownCode> lambda = lambdaAt(tokens, i)) functions.push_back(std::move(*lambda));
  return functions;
}

std::vector<ShownCode> longExpressionsIn(std::string_view source) {
  const std::string text = flattened(source);
  const CppText flat(text);
  std::vector<ShownCode> all;
  for (const CppPiece& piece : submission::cppPieces(flat)) {
    if (piece.isDirective) continue;
    std::optional<ShownCode> function;
    if (!piece.function.empty()) function = functionOf(flat, source, piece);
    for (ShownCode& one : Expressions(flat, piece, function ? &*function : nullptr).find())
      all.push_back(std::move(one));
  }
  return all;
}

std::string neededPart(std::string_view source, const std::vector<ShownCode>& wanted) {
  const std::string text = flattened(source);
  const CppText flat(text);
  const std::vector<CppPiece> pieces = submission::cppPieces(flat);
  std::vector<bool> isKept;
  submission::Names names;
  for (const CppPiece& piece : pieces) {
    isKept.push_back(piece.function.empty());
    if (isKept.back()) names.merge(submission::namesIn(flat, piece.first, piece.last));
  }
  for (const ShownCode& one : wanted) {
    const CppText its(one.text);
    names.merge(submission::namesIn(its, 0, its.size()));
  }
  for (bool isGrowing = true; isGrowing;) {
    isGrowing = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (isKept[i] || pieces[i].function == "main" || !names.contains(pieces[i].function)) continue;
      isKept[i] = isGrowing = true;
      names.merge(submission::namesIn(flat, pieces[i].first, pieces[i].last));
    }
  }
  std::string part;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!isKept[i] || pieces[i].isDirective) continue;
    // With the words before it on its line, such as `inline constexpr`.
    const std::size_t line = source.find_last_of("\n;{}", pieces[i].start - 1);
    const std::size_t start = pieces[i].start == 0 || line == source.npos ? 0 : line + 1;
    part += std::string(source.substr(start, pieces[i].end - start)) + '\n';
  }
  return part;
}

bool fits(std::string_view type, std::string_view wanted) {
  if (type == wanted || (isNumber(type) && isNumber(wanted))) return !type.empty();
  const std::optional<Dense> one = denseOf(type), other = denseOf(wanted);
  return one && other && one->kind == other->kind &&
         (one->size == other->size || one->size == "X" || other->size == "X");
}

}  // namespace rex::authoring
