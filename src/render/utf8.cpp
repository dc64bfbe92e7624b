#include <array>

#include "base/printable.h"
#include "render/utf8_internal.h"

namespace rex::internal {
namespace {

constexpr char32_t kInvalid = 0xFFFD;

// Length of the character that starts with `lead`; 0: no character starts with it.
int lengthOf(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

// The character at the start of `text` and its length; (kInvalid, 1) if there is none.
std::pair<char32_t, int> first(std::string_view text) {
  constexpr std::array<char32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const auto lead = static_cast<unsigned char>(text[0]);
  const int length = lengthOf(lead);
  if (length == 1) return {lead, 1};
  if (length == 0 || text.size() < static_cast<std::size_t>(length)) return {kInvalid, 1};
  char32_t character = lead & (0x7Fu >> length);
  for (int k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[k]);
    if ((next & 0xC0) != 0x80) return {kInvalid, 1};
    character = character << 6 | (next & 0x3Fu);
  }
  const bool surrogate = character >= 0xD800 && character < 0xE000;
  if (character < kSmallest[length] || character > 0x10FFFF || surrogate) return {kInvalid, 1};
  return {character, length};
}

}  // namespace

std::u32string charactersOf(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const auto [character, length] = first(text);
    characters.push_back(character);
    text.remove_prefix(static_cast<std::size_t>(length));
  }
  return characters;
}

std::string singleLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const auto [character, length] = first(text);
    if (isInvisible(character) || character >= 0xFFFE)
      line += ' ';
    else if (character == kInvalid)
      line += '?';
    else
      line += text.substr(0, static_cast<std::size_t>(length));
    text.remove_prefix(static_cast<std::size_t>(length));
  }
  return line;
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (;;) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 1);
  }
}

std::string singleLines(std::string_view text) {
  std::string lines;
  for (const std::string_view line : linesOf(text)) lines += singleLine(line) + '\n';
  lines.pop_back();
  return lines;
}

}  // namespace rex::internal
