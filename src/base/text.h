#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace rex {

/// The text with A to Z replaced by a to z.
[[nodiscard]] std::string lowerCase(std::string_view text);

/// The extension of a file in lower case: ".urdf"; empty if there is none.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file);

/// The texts in a row, with `between` between neighbours: "a, b, c". (fmt's formatting of ranges takes
/// seconds to compile.)
template <class Texts>
[[nodiscard]] std::string join(const Texts& texts, std::string_view between) {
  std::string all;
  for (auto text = std::begin(texts); text != std::end(texts); ++text) {
    if (text != std::begin(texts)) all += between;
    all += *text;
  }
  return all;
}

/// The lines of a text, without their line ends, as views into it.
inline std::vector<std::string_view> splitLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace rex

// Text taken apart. All parts are views into the text, so that `columnIn()` finds where they begin.
namespace rex {

/// The text without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The text without the byte order mark with which some programs begin UTF-8.
[[nodiscard]] std::string_view withoutByteOrderMark(std::string_view text);

/// The parts between separators: one more than there are separators.
[[nodiscard]] std::vector<std::string_view> splitAt(std::string_view text, char separator);

/// The words between blanks.
[[nodiscard]] std::vector<std::string_view> splitWords(std::string_view text);

/// The words between commas or blanks. Between two commas there is at least one, perhaps empty; after the
/// last comma there may be none.
[[nodiscard]] std::vector<std::string_view> splitList(std::string_view text);

/// The column of a part in the text, from 1.
[[nodiscard]] inline int columnIn(std::string_view text, std::string_view part) {
  return static_cast<int>(part.data() - text.data()) + 1;
}

/// Removes a number from the front of `text` and returns it. Nothing, and no change, if the text does not
/// begin with one, or if it does not fit its type. Like std::from_chars: no blanks and no '+' before it.
template <class Number>
std::optional<Number> takeNumber(std::string_view& text, int base = 10) {
  Number number{};
  const char* const last = text.data() + text.size();
  std::from_chars_result result{};
  if constexpr (std::is_floating_point_v<Number>)
    result = std::from_chars(text.data(), last, number);
  else
    result = std::from_chars(text.data(), last, number, base);
  if (result.ec != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  return number;
}

/// The number that is the whole text, which may begin with '+'. Nothing for any other text, for a number that
/// does not fit its type, and for "inf" and "nan".
template <class Number>
[[nodiscard]] std::optional<Number> parseNumber(std::string_view text, int base = 10) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const std::optional<Number> number = takeNumber<Number>(text, base);
  if (!text.empty()) return {};
  if constexpr (std::is_floating_point_v<Number>)
    if (number && !std::isfinite(*number)) return {};
  return number;
}

/// Whether a text is written as a number, without '+', be it infinite, not a number or too large.
[[nodiscard]] bool isNumeral(std::string_view text);

/// The bytes that pairs of hexadecimal digits stand for.
[[nodiscard]] std::string bytesOfHex(std::string_view digits);

}  // namespace rex
