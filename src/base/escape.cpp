#include "base/escape.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

#include "base/printable.h"
#include "base/text.h"

namespace rex {
namespace {

bool isOneOf(std::string_view signs, char c) { return signs.find(c) != std::string_view::npos; }

// A character written by its number is not markup.
std::string numbered(char c) { return fmt::format("&#{};", static_cast<int>(c)); }

std::string withNumbers(std::string_view text, std::string_view markup) {
  std::string safe;
  for (const char c : text) safe += isOneOf(markup, c) ? numbered(c) : std::string(1, c);
  return safe;
}

// Percent-encodes special characters, which workflow commands decode again.
std::string withPercents(std::string_view text, std::string_view special) {
  std::string safe;
  for (const char c : printable(text))
    safe += isOneOf(special, c) ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  return safe;
}

// = + - @ and the variants that spreadsheets treat alike: full-width and small forms, the minus sign.
constexpr auto kFormulaSigns =
    std::to_array<std::string_view>({"=", "+", "-", "@", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20", "\uFE66",
                                     "\uFE62", "\uFE63", "\uFE6B", "\u2212"});

// Blanks that some readers remove from the start of a cell.
constexpr auto kCellBlanks = std::to_array<std::string_view>({" ", "\u00A0", "\u3000", "\uFFFD"});

bool startsWithAny(std::string_view text, const auto& starts) {
  return std::any_of(starts.begin(), starts.end(), [&](auto start) { return text.starts_with(start); });
}

// A cell in one dialect of CSV may begin in the middle of a field in another.
std::string withoutFormulas(std::string_view text) {
  std::string safe;
  bool isStart = true;
  while (!text.empty()) {
    if (isStart && startsWithAny(text, kFormulaSigns)) safe += '\'';
    std::size_t length = 1;
    while (length < text.size() && (static_cast<std::uint8_t>(text[length]) & 0xC0) == 0x80) ++length;
    isStart = isOneOf(",;|\t\n\"", text.front()) || (isStart && startsWithAny(text, kCellBlanks));
    safe += text.substr(0, length);
    text.remove_prefix(length);
  }
  return safe;
}

std::string jsonEscape(char32_t character) {
  if (character < 0x10000) return fmt::format("\\u{:04x}", static_cast<std::uint32_t>(character));
  const auto beyond = static_cast<std::uint32_t>(character) - 0x10000;
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + (beyond >> 10), 0xDC00 + (beyond & 0x3FF));
}

}  // namespace

std::string xmlText(std::string_view text) { return withNumbers(printable(text), "&<>\"\n\t"); }

std::string htmlText(std::string_view text) { return withNumbers(printable(text), "&<>\"'`"); }

std::string markdownText(std::string_view text) {
  // Parentheses and exclamation marks are nothing without brackets, an underscore nothing inside a word.
  constexpr std::string_view kMarkup = "&<>|\\`*~[]#$@";
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const std::string shown = printable(text);
  std::string safe;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const char c = shown[k];
    // Addresses would become links automatically.
    const bool isAddress =
        (c == ':' && shown.compare(k + 1, 1, "/") == 0) || (c == '.' && k > 0 && shown[k - 1] == 'w');
    const bool isEmphasis =
        c == '_' && (k == 0 || k + 1 == shown.size() || !isWord(shown[k - 1]) || !isWord(shown[k + 1]));
    if (c == '\n' || c == '\t')
      safe += ' ';
    else
      safe += isAddress || isEmphasis || isOneOf(kMarkup, c) ? numbered(c) : std::string(1, c);
  }
  return safe;
}

std::string markdownBlock(std::string_view text) {
  const std::string shown = printable(text);
  std::string safe;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const bool isCommand = shown.compare(k, 2, "::") == 0 || shown.compare(k, 2, "##") == 0;
    safe += isCommand || isOneOf("&<>", shown[k]) ? numbered(shown[k]) : std::string(1, shown[k]);
  }
  return safe;
}

std::string csvField(std::string_view text) {
  const std::string shown = printable(text);
  const std::string safe = isNumeral(shown) ? shown : withoutFormulas(shown);
  if (safe.find_first_of(",;\t\"\r\n") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string commandMessage(std::string_view text) { return withPercents(text, "%\r\n"); }

std::string commandProperty(std::string_view text) { return withPercents(text, "%\r\n:,"); }

std::string visibleJson(std::string_view json) {
  std::string safe;
  for (std::size_t k = 0; k < json.size();) {
    const auto lead = static_cast<std::uint8_t>(json[k]);
    std::size_t length = lead < 0xC0 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    length = std::min(length, json.size() - k);
    char32_t character = length == 1 ? lead : lead & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i)
      character = character << 6 | (static_cast<std::uint8_t>(json[k + i]) & 0x3Fu);
    const bool isMarked = character >= 0x7F && isInvisible(character);
    safe += isMarked ? jsonEscape(character) : std::string(json.substr(k, length));
    k += length;
  }
  return safe;
}

std::string terminalText(std::string_view text) {
  constexpr auto kColours =
      std::to_array<std::string_view>({"\033[0m", "\033[1m", "\033[31m", "\033[32m", "\033[33m"});
  std::string safe;
  while (!text.empty()) {
    const std::size_t escape = std::min(text.find('\033'), text.size());
    safe += printable(text.substr(0, escape));
    text.remove_prefix(escape);
    if (text.empty()) break;
    const auto colour = std::find_if(kColours.begin(), kColours.end(),
                                     [&](std::string_view code) { return text.starts_with(code); });
    const std::size_t length = colour == kColours.end() ? 1 : colour->size();
    safe += colour == kColours.end() ? printable(text.substr(0, 1)) : std::string(*colour);
    text.remove_prefix(length);
  }
  return safe;
}

}  // namespace rex
