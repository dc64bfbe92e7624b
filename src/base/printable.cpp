#include "base/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>

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

bool isShown(std::string_view sequence) {
  return sequence == "\n" || sequence == "\t" || (!sequence.empty() && !isInvisible(characterOf(sequence)));
}

}  // namespace

bool isInvisible(char32_t character) {
  if ((character & 0xFFFE) == 0xFFFE) return true;
  const auto range = std::lower_bound(kInvisible.begin(), kInvisible.end(), character,
                                      [](const CodeRange& a, char32_t c) { return a.last < c; });
  return range != kInvisible.end() && range->first <= character;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    const std::string_view sequence = text.substr(0, length);
    const std::string_view shown = isShown(sequence) ? sequence : kReplacement;
    if (safe.size() + shown.size() > limit) break;
    safe += shown;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

}  // namespace rex
