#include "base/escape.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

#include "base/text.h"

namespace rex {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct CodeRange {
  char32_t first, last;
};

// Unicode 15, in order. The last two codes of each plane are left to isInvisible().
constexpr auto kInvisible = std::to_array<CodeRange>({
    {0x00, 0x1F},       {0x7F, 0x9F},       {0xAD, 0xAD},       {0x34F, 0x34F},     {0x600, 0x605},
    {0x61C, 0x61C},     {0x6DD, 0x6DD},     {0x70F, 0x70F},     {0x890, 0x891},     {0x8E2, 0x8E2},
    {0x115F, 0x1160},   {0x17B4, 0x17B5},   {0x180B, 0x180F},   {0x200B, 0x200F},   {0x2028, 0x202E},
    {0x2060, 0x206F},   {0x3164, 0x3164},   {0xD800, 0xDFFF},   {0xFDD0, 0xFDEF},   {0xFE00, 0xFE0F},
    {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},   {0xFFF0, 0xFFFB},   {0x110BD, 0x110BD}, {0x110CD, 0x110CD},
    {0x13430, 0x1343F}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF},
});

// The length of the valid UTF-8 sequence at the start of a text, or 0: neither overlong, nor half of a
// surrogate pair, nor beyond U+10FFFF.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t length = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
  }
  const bool overlong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xF0 && byte(1) < 0x90);
  const bool surrogate = byte(0) == 0xED && byte(1) >= 0xA0;
  const bool tooLarge = byte(0) == 0xF4 && byte(1) >= 0x90;
  return overlong || surrogate || tooLarge ? 0 : length;
}

char32_t characterOf(std::string_view sequence) {
  const auto lead = static_cast<std::uint8_t>(sequence[0]);
  if (sequence.size() == 1) return lead;
  char32_t character = lead & (0x7Fu >> sequence.size());
  for (const char c : sequence.substr(1)) character = character << 6 | (static_cast<std::uint8_t>(c) & 0x3Fu);
  return character;
}

// Joiners, which choose the forms of their neighbours, and selectors of variants.
constexpr auto kJoiners = std::to_array<CodeRange>({{0x200C, 0x200D}});
constexpr auto kSelectors =
    std::to_array<CodeRange>({{0x34F, 0x34F}, {0x180B, 0x180F}, {0xFE00, 0xFE0F}, {0xE0100, 0xE01EF}});

// Scripts and signs that need them: from Hebrew to Tai Tham, symbols, East Asia, forms of Arabic, emoji.
constexpr auto kJoinedScripts = std::to_array<CodeRange>({{0x590, 0x1CFF},
                                                          {0x2190, 0x2BFF},
                                                          {0x2E80, 0xD7FF},
                                                          {0xF900, 0xFAFF},
                                                          {0xFB1D, 0xFDFF},
                                                          {0xFE70, 0xFEFC},
                                                          {0x10000, 0x3FFFF}});

constexpr auto kAddedBySpreadsheets =
    std::to_array<CodeRange>({{0xAD, 0xAD}, {0x200B, 0x200B}, {0x200E, 0x200F}, {0xFEFF, 0xFEFF}});

bool isAmong(const auto& ranges, char32_t character) {
  const auto range = std::lower_bound(ranges.begin(), ranges.end(), character,
                                      [](const CodeRange& a, char32_t c) { return a.last < c; });
  return range != ranges.end() && range->first <= character;
}

/// Whether the next character of a text is shown, which may depend on the one before.
class ShownCharacters {
 public:
  bool take(char32_t character) {
    const bool isSelector = isAmong(kSelectors, character), isJoiner = isAmong(kJoiners, character);
    const bool isNeeded = (isSelector && before_ == Before::kJoined) ||
                          (isJoiner && (before_ == Before::kJoined || before_ == Before::kSelected));
    const bool isShown = character == '\n' || character == '\t' || isNeeded || !isInvisible(character);
    const bool isJoined = isShown && !isNeeded && isAmong(kJoinedScripts, character);
    before_ = isJoined ? Before::kJoined : isNeeded && isSelector ? Before::kSelected : Before::kOther;
    return isShown;
  }

 private:
  enum class Before { kOther, kJoined, kSelected };  ///< a character of such a script, with its selector
  Before before_ = Before::kOther;
};

}  // namespace

bool isInvisible(char32_t character) {
  return (character & 0xFFFE) == 0xFFFE || isAmong(kInvisible, character);
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string safe;
  ShownCharacters shownCharacters;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    const std::string_view sequence = text.substr(0, length);
    const bool isShown = shownCharacters.take(length == 0 ? U'\0' : characterOf(sequence));
    const std::string_view shown = isShown ? sequence : kReplacement;
    if (safe.size() + shown.size() > limit) break;
    safe += shown;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

CleanName cleanName(std::string_view text) {
  CleanName name;
  ShownCharacters shownCharacters;
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(sequenceLength(text), 1);
    const std::string_view sequence = text.substr(0, length);
    const char32_t character = sequenceLength(text) == 0 ? U'\0' : characterOf(sequence);
    const bool isAdded = isAmong(kAddedBySpreadsheets, character);
    const bool isStray = !isAdded && !shownCharacters.take(character) &&
                         (isAmong(kJoiners, character) || isAmong(kSelectors, character));
    if (isAdded || isStray)
      name.lost.insert(fmt::format("U+{:04X}", static_cast<std::uint32_t>(character)));
    else
      name.text += sequence;
    text.remove_prefix(length);
  }
  if (!name.lost.empty()) name.text = std::string(trimmed(name.text));
  return name;
}

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
