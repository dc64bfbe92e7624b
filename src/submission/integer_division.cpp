#include "submission/integer_division.h"

#include <fmt/format.h>

#include "base/text.h"

namespace rex::grading {
namespace {

// The value of a number of at most nine decimal digits; 0 for any other token.
long wholeNumber(const CppText& text, std::size_t i) {
  constexpr std::size_t kMostDigits = 9;
  const std::string_view digits = text.at(i);
  if (!text.isKind(i, TokenKind::kNumber) || digits.size() > kMostDigits) return 0;
  return parseNumber<long>(digits).value_or(0);
}

}  // namespace

std::vector<CompileDiagnostic> integerDivisions(const CppText& text, const std::string& name) {
  const TextPlaces places(text.source());
  std::vector<CompileDiagnostic> found;
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

}  // namespace rex::grading
