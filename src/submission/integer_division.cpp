#include "submission/integer_division.h"

#include <cctype>
#include <charconv>
#include <regex>

#include <fmt/format.h>

#include "base/lines.h"

namespace rex::grading {
namespace {

using Match = std::match_results<std::string_view::const_iterator>;

// Numbers from code have at most this many digits.
long valueOf(const std::string& digits) {
  constexpr std::size_t kMostDigits = 9;
  long value = 0;
  if (digits.size() <= kMostDigits) std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

// The part of a line before a comment; `inComment` says whether it begins in one, and becomes so for the
// next.
std::string_view codeOf(std::string_view line, bool& inComment) {
  if (inComment) {
    const std::size_t end = line.find("*/");
    if (end == line.npos) return {};
    inComment = false;
    return codeOf(line.substr(end + 2), inComment);
  }
  const std::size_t start = line.find("/*"), rest = line.find("//");
  if (start < rest) {
    inComment = line.find("*/", start + 2) == line.npos;
    return line.substr(0, start);
  }
  return line.substr(0, rest);
}

// Whether the digits at `at` are those behind the sign of 1e-3.
bool isExponent(std::string_view code, std::size_t at) {
  if (at < 3 || (code[at - 1] != '-' && code[at - 1] != '+')) return false;
  const bool hasMark = code[at - 2] == 'e' || code[at - 2] == 'E';
  return hasMark && (std::isdigit(static_cast<unsigned char>(code[at - 3])) || code[at - 3] == '.');
}

}  // namespace

std::vector<CompileDiagnostic> integerDivisions(std::string_view source, const std::string& name) {
  static const std::regex pattern(R"((^|[^\w.'/])(\d+) */ *(\d+)(?![\w.']))");
  std::vector<CompileDiagnostic> found;
  bool inComment = false;
  int number = 0;
  for (const std::string_view line : splitLines(source)) {
    ++number;
    const std::string_view code = codeOf(line, inComment);
    if (code.find('"') != code.npos || code.starts_with('#')) continue;
    Match match;
    for (auto at = code.begin(); std::regex_search(at, code.end(), match, pattern); at = match[0].second) {
      const long a = valueOf(match[2].str()), b = valueOf(match[3].str());
      const auto start = static_cast<std::size_t>(match[2].first - code.begin());
      if (b == 0 || a % b == 0 || isExponent(code, start)) continue;
      const auto column = static_cast<int>(start) + static_cast<int>(code.begin() - line.begin()) + 1;
      found.push_back(
          {name, number, column, "warning", "integer-division",
           fmt::format("{0} / {1} is {2}, as both are whole numbers: write {0}. / {1}", a, b, a / b)});
    }
  }
  return found;
}

}  // namespace rex::grading
