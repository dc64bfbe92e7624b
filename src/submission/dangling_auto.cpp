#include "submission/dangling_auto.h"

#include <algorithm>
#include <optional>
#include <regex>

#include <fmt/format.h>

#include "base/lines.h"

namespace rex::grading {
namespace {

struct Declaration {
  std::string name;
  std::size_t end = 0;     // after the semicolon
  bool isView = false;     // begins as a view of what a function returned
  std::size_t column = 0;  // of `auto`, from 1
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

// The bracket that the one at `close` closes.
std::size_t openingOf(std::string_view text, std::size_t close) {
  int depth = 0;
  for (std::size_t i = close + 1; i-- > 0;) {
    if (text[i] == ')') ++depth;
    if (text[i] == '(' && --depth == 0) return i;
  }
  return 0;
}

// Whether it looks at a part of what a function returned, as in p.position(i).head(2). Eigen's own functions
// that return views do no harm.
bool isViewOfAnswer(const std::string& value) {
  static const std::string views =
      "(head|tail|segment|row|col|block|(top|bottom|middle)Rows|(left|right|middle)Cols|"
      "(top|bottom)(Left|Right)Corner|transpose|diagonal|array|matrix|reshaped)";
  static const std::regex view(R"(\)\s*\.\s*)" + views + R"(\b)"), ofEigen(R"((^|\W))" + views + R"(\s*$)"),
      call(R"(\w\s*$)");
  for (std::sregex_iterator found(value.begin(), value.end(), view), end; found != end; ++found) {
    const auto open = openingOf(value, static_cast<std::size_t>(found->position()));
    const std::string before = value.substr(0, open);
    if (std::regex_search(before, call) && !std::regex_search(before, ofEigen)) return true;
  }
  return false;
}

// A statement that begins the line, ends on it and declares one variable.
std::optional<Declaration> declarationIn(std::string_view line) {
  static const std::regex pattern(R"(^(\s*)(const\s+)?auto\s+([A-Za-z_]\w*)\s*=([^;']*);\s*(//.*)?$)");
  std::match_results<std::string_view::const_iterator> found;
  if (!std::regex_match(line.begin(), line.end(), found, pattern)) return {};
  const std::string value = found[4].str();
  if (!hasBalancedBrackets(value)) return {};
  return Declaration{.name = found[3].str(),
                     .end = static_cast<std::size_t>(found[4].second - line.begin()) + 1,
                     .isView = isViewOfAnswer(value),
                     .column = static_cast<std::size_t>(found[1].length()) + 1};
}

constexpr std::string_view kQuestion = "rex::guard::auto";

}  // namespace

std::string withAutoQuestions(std::string_view source) {
  std::string text;
  bool asks = false;
  for (const std::string_view line : splitLines(source)) {
    if (const auto declared = declarationIn(line)) {
      text.append(line.substr(0, declared->end))
          .append(fmt::format(" static_assert(sizeof(::{}{}({})) == 1);", kQuestion,
                              declared->isView ? "Views" : "Holds", declared->name))
          .append(line.substr(declared->end));
      asks = true;
    } else {
      text.append(line);
    }
    text += '\n';
  }
  return asks ? text : "";
}

void explainAutoAnswers(std::vector<CompileDiagnostic>& messages, std::string_view source) {
  const std::vector<std::string_view> lines = splitLines(source);
  const auto isAbout = [](const CompileDiagnostic& message) {
    return message.message.find(kQuestion) != std::string::npos;
  };
  std::erase_if(messages, [&](const CompileDiagnostic& message) {
    return isAbout(message) && message.severity == "note";
  });
  for (CompileDiagnostic& message : messages) {
    if (!isAbout(message) || message.line < 1 || static_cast<std::size_t>(message.line) > lines.size())
      continue;
    const auto declared = declarationIn(lines[static_cast<std::size_t>(message.line) - 1]);
    if (!declared) continue;
    message.column = static_cast<int>(declared->column);
    message.rule = "eigen-auto";
    message.message = fmt::format(
        "'auto' makes '{0}' an expression that refers to other values, which may be gone when it is used: "
        "write its type instead, such as Eigen::VectorXd {0}, or end it with .eval()",
        declared->name);
  }
}

}  // namespace rex::grading
