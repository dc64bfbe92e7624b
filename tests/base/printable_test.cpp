#include <cstdint>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/escape.h"
#include "base/process.h"
#include "base/rng.h"

namespace rex::printable_test {

const std::string kMark = "\xEF\xBF\xBD";

TEST(Printable, KeepsTextAndReplacesWhatIsNotText) {
  EXPECT_EQ(printable("a\tb\n", 100), "a\tb\n");
  EXPECT_EQ(printable("\u00e4\u20ac\U0001F916", 100), "\u00e4\u20ac\U0001F916");
  EXPECT_EQ(printable("\x1b[31m", 100), kMark + "[31m");
  EXPECT_EQ(printable(std::string_view("\0\x7f\r", 3), 100), kMark + kMark + kMark);
  EXPECT_EQ(printable("\xC2\x9B", 100), kMark);                      // a control character of Latin-1
  EXPECT_EQ(printable("\xC0\xAF", 100), kMark + kMark);              // overlong
  EXPECT_EQ(printable("\xED\xA0\x80", 100), kMark + kMark + kMark);  // half of a surrogate pair
  EXPECT_EQ(printable("\xF4\x90\x80\x80", 100), kMark + kMark + kMark + kMark);  // beyond the last character
  EXPECT_EQ(printable("a\xE2\x82", 100), "a" + kMark + kMark);                   // cut off
}

TEST(Printable, ShowsWhatHasNoLookOfItsOwn) {
  for (const char* text :
       {"\u202E", "\u2066", "\u2069", "\u200B", "\u200D", "\uFEFF", "\u2028", "\u2029", "\u0085", "\u00AD",
        "\u061C", "\u3164", "\uFE0F", "\U000E0041", "\uFFFE", "\U0010FFFF"}) {
    EXPECT_EQ(printable(text), kMark) << nlohmann::json(text);
    EXPECT_EQ(printable(printable(text)), kMark);
  }
  for (const char* text : {"\u00A0", "\u0301", "\u3000", "\u05D0", "\uFF1D", "\uFFFD", "\U0001F916"})
    EXPECT_EQ(printable(text), text);
}

// Python's tables are another opinion: all of the categories Cc, Cf, Zl, Zp and Cs, and nothing that has
// another look than a format character, a filler or a variation selector.
TEST(Printable, AgreesWithPythonsTables) {
  const ProcessResult python = runProcess(
      {"python3", "-c",
       "import unicodedata as u\n"
       "for c in [*range(0x18000), *range(0x1B000, 0x20000), *range(0xE0000, 0xE1000), 0x10FFFE, 0x10FFFF]:\n"
       "    k = u.category(chr(c))\n"
       "    never = c & 0xFFFE == 0xFFFE or 0xFDD0 <= c <= 0xFDEF\n"
       "    n = u.name(chr(c), '') if k in ('Mn', 'Lo') else ''\n"
       "    ignored = 'VARIATION SELECTOR' in n or ('HANGUL' in n and n.endswith('FILLER'))\n"
       "    ignored = ignored or 'GRAPHEME JOINER' in n or 'INHERENT' in n\n"
       "    if k == 'Cn' and not never: continue\n"
       "    print(c, int(never or ignored or k in ('Cc', 'Cf', 'Zl', 'Zp', 'Cs')))\n"});
  if (!python.started) GTEST_SKIP() << "python3 is not installed";
  ASSERT_TRUE(python.ok()) << python.error;
  std::istringstream lines(python.output);
  int count = 0;
  for (std::uint32_t code = 0, invisible = 0; lines >> code >> invisible; ++count)
    EXPECT_EQ(isInvisible(code), invisible == 1) << std::hex << code;
  EXPECT_GT(count, 80'000);
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("ab\u20ac", 5), "ab\u20ac");
  EXPECT_EQ(printable("ab\u20ac", 4), "ab");
}

// The JSON library has its own check of UTF-8 and throws for what is invalid.
TEST(Printable, IsValidForEveryInput) {
  Rng rng(2);
  for (int k = 0; k < 20000; ++k) {
    std::string text(rng.index(12), '\0');
    for (char& c : text) c = static_cast<char>(rng.index(2) == 0 ? 0x80 + rng.index(128) : rng.index(256));
    EXPECT_NO_THROW(static_cast<void>(nlohmann::json(printable(text, 30)).dump()));
  }
}

}  // namespace rex::printable_test
