#include "base/printable.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rng.h"

namespace rex::grading::printable_test {

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

}  // namespace rex::grading::printable_test
