#include "cli/number_words.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>
#include <system_error>

#include "base/error.h"

namespace rex::cli {
namespace {

// The words of one field between commas.
std::vector<std::string> wordsOf(const std::string& field) {
  std::istringstream input(field);
  return {std::istream_iterator<std::string>(input), {}};
}

}  // namespace

Refusal refusalOf(const std::string& option) {
  return [option](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = option, .found = found, .wanted = wanted});
  };
}

std::vector<std::string> numberWords(std::string_view text, const Refusal& refuse) {
  if (text.find(';') != std::string_view::npos) refuse("';'", "commas or blanks between numbers");
  std::vector<std::string> all;
  while (true) {
    const std::size_t size = text.find(',');
    const bool isLast = size == std::string_view::npos;
    const std::vector<std::string> some = wordsOf(std::string(text.substr(0, size)));
    if (some.empty() && !isLast) refuse("an empty field", "a number between commas");
    all.insert(all.end(), some.begin(), some.end());
    if (isLast) return all;
    text.remove_prefix(size + 1);
  }
}

bool isNumeral(std::string_view word, double& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  return problem == std::errc() && end == word.data() + word.size();
}

std::optional<double> numberIn(std::string_view word) {
  double number = 0;
  if (!isNumeral(word, number) || !std::isfinite(number)) return {};
  return number;
}

}  // namespace rex::cli
