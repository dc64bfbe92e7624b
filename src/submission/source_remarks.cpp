#include "submission/source_remarks.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "base/text.h"

namespace rex::submission {
namespace {

// The value of a number of at most nine decimal digits; 0 for any other token.
long wholeNumber(const CppText& text, std::size_t i) {
  constexpr std::size_t kMostDigits = 9;
  const std::string_view digits = text.at(i);
  if (!text.isKind(i, TokenKind::kNumber) || digits.size() > kMostDigits) return 0;
  return parseNumber<long>(digits).value_or(0);
}

}  // namespace

std::vector<grading::CompileDiagnostic> integerDivisions(const CppText& text, const std::string& name) {
  const TextPlaces places(text.source());
  std::vector<grading::CompileDiagnostic> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.startsDirective(i)) {
      i = text.nextLine(i) - 1;
      continue;
    }
    const long a = wholeNumber(text, i), b = text.isSign(i + 1, '/') ? wholeNumber(text, i + 2) : 0;
    const bool isDivisor = i > 0 && text.isSign(i - 1, '/');
    if (a == 0 || b == 0 || a % b == 0 || isDivisor) continue;
    const auto [line, column] = places.place(text[i].start);
    found.push_back(
        {name, line, column, "warning", "integer-division",
         fmt::format("{0} / {1} is {2}, as both are whole numbers: write {0}. / {1}", a, b, a / b)});
  }
  return found;
}

namespace {

struct Declaration {
  std::string_view name;
  std::size_t start = 0, end = 0;  // of its characters, with the semicolon
  bool isView = false;             // begins as a view of what a function returned
};

bool hasBalancedBrackets(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (depth < 0) return false;
  }
  return depth == 0;
}

bool isViewOfEigen(std::string_view function) {
  constexpr auto kViews = std::to_array<std::string_view>({"array",
                                                           "block",
                                                           "bottomLeftCorner",
                                                           "bottomRightCorner",
                                                           "bottomRows",
                                                           "col",
                                                           "diagonal",
                                                           "head",
                                                           "leftCols",
                                                           "matrix",
                                                           "middleCols",
                                                           "middleRows",
                                                           "reshaped",
                                                           "rightCols",
                                                           "row",
                                                           "segment",
                                                           "tail",
                                                           "topLeftCorner",
                                                           "topRightCorner",
                                                           "topRows",
                                                           "transpose"});
  return std::ranges::binary_search(kViews, function);
}

// Whether it looks at a part of what a function returned, as in p.position(i).head(2). Eigen's own functions
// that return views do no harm.
bool isViewOfAnswer(const CppText& text, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i + 2 < end; ++i) {
    if (!text.isSign(i, ')') || !text.isSign(i + 1, '.') || !isViewOfEigen(text.at(i + 2))) continue;
    const std::size_t open = text.partner(i);
    if (open > first && open < i && text.isName(open - 1) && !isViewOfEigen(text.at(open - 1))) return true;
  }
  return false;
}

// A statement that begins the line of token `i`, ends on it and declares one variable. Nothing but a comment
// follows it.
std::optional<Declaration> declarationAt(const CppText& text, std::size_t i, std::size_t nextLine) {
  const std::size_t name = i + (text.at(i) == "const" ? 2 : 1), last = nextLine - 1;
  if (name + 2 > last || text.at(name - 1) != "auto" || !text.isName(name) || !text.isSign(name + 1, '=') ||
      !text.isSign(last, ';'))
    return {};
  const std::size_t start = text[name + 1].end;
  const std::string_view value = text.source().substr(start, text[last].start - start);
  if (value.find_first_of(";'\n") != value.npos || !hasBalancedBrackets(value)) return {};
  return Declaration{.name = text.at(name),
                     .start = text[i].start,
                     .end = text[last].end,
                     .isView = isViewOfAnswer(text, name + 2, last)};
}

std::vector<Declaration> declarationsIn(const CppText& text) {
  std::vector<Declaration> found;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t next = text.nextLine(i);
    if (const auto declared = declarationAt(text, i, next)) found.push_back(*declared);
    i = next;
  }
  return found;
}

constexpr std::string_view kQuestion = "rex::guard::auto";

}  // namespace

std::string withAutoQuestions(const CppText& text) {
  std::string asking;
  std::size_t done = 0;
  for (const Declaration& declared : declarationsIn(text)) {
    asking.append(text.source().substr(done, declared.end - done))
        .append(fmt::format(" static_assert(sizeof(::{}{}({})) == 1);", kQuestion,
                            declared.isView ? "Views" : "Holds", declared.name));
    done = declared.end;
  }
  return done == 0 ? "" : asking.append(text.source().substr(done));
}

void explainAutoAnswers(std::vector<grading::CompileDiagnostic>& messages, const CppText& text) {
  const auto isAbout = [](const grading::CompileDiagnostic& message) {
    return message.message.find(kQuestion) != std::string::npos;
  };
  std::erase_if(messages, [&](const grading::CompileDiagnostic& message) {
    return isAbout(message) && message.severity == "note";
  });
  const TextPlaces places(text.source());
  std::map<int, Declaration> byLine;
  for (const Declaration& declared : declarationsIn(text)) byLine[places.line(declared.start)] = declared;
  for (grading::CompileDiagnostic& message : messages) {
    const auto declared = byLine.find(message.line);
    if (!isAbout(message) || declared == byLine.end()) continue;
    message.column = places.place(declared->second.start).second;
    message.rule = "eigen-auto";
    message.message = fmt::format(
        "'auto' makes '{0}' an expression that refers to other values, which may be gone when it is used: "
        "write its type instead, such as Eigen::VectorXd {0}, or end it with .eval()",
        declared->second.name);
  }
}

}  // namespace rex::submission
