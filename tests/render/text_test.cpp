#include "render/text.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "render/text_internal.h"

namespace rex::text_test {

constexpr Color kBlack{0, 0, 0};

Image page(int width, int height, std::uint8_t grey) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), grey);
  return image;
}

int countDark(const Image& image) {
  int dark = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) dark += image.at(x, y)[0] < 80 ? 1 : 0;
  return dark;
}

TEST(Text, EachPrintableCharacterHasItsOwnPicture) {
  std::set<std::vector<std::uint8_t>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    Image image = page(30, 30, 255);
    drawText(image, std::string(1, c), 4, 4, kBlack, 1.5);
    EXPECT_GT(countDark(image), 0) << c;
    EXPECT_TRUE(seen.insert(image.rgb).second) << c << " looks like another character";
  }
}

TEST(Text, StaysWithinItsSize) {
  const std::string text = "Wgjpq|{}[]()@ 0123";
  for (const double scale : {1.0, 1.5, 3.0}) {
    const TextSize size = textSize(text, scale);
    const int edge = 4;  // the soft edge may reach this far out
    Image image = page(size.width + 40, size.height + 40, 255);
    drawText(image, text, 20, 20, kBlack, scale);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const bool inside =
            x >= 20 - edge && x < 20 + size.width + edge && y >= 20 - edge && y < 20 + size.height + edge;
        EXPECT_TRUE(inside || image.at(x, y)[0] == 255) << x << ' ' << y;
      }
  }
}

TEST(Text, ReadsOnAnyGround) {
  for (const int grey : {0, 60, 128, 255}) {
    Image image = page(100, 20, static_cast<std::uint8_t>(grey));
    drawText(image, "label", 4, 2, kBlack);
    int bright = 0;
    for (int x = 0; x < 100; ++x)
      for (int y = 0; y < 20; ++y) bright += image.at(x, y)[0] > 170 ? 1 : 0;
    EXPECT_GT(countDark(image), 30) << grey;
    EXPECT_GT(bright, 30) << grey;
  }
}

TEST(Text, IsCutAtTheBorder) {
  Image image = page(10, 10, 255);
  for (const int at : {-1000, -5, 5, 1000}) drawText(image, "cut here", at, at, kBlack, 2);
  EXPECT_NE(image, page(10, 10, 255));
}

TEST(Text, CoversTheSameStrokesWithAndWithoutScale) {
  Image small = page(200, 40, 255), large = page(400, 80, 255);
  drawText(small, "Hello, 123", 2, 2, kBlack, 1);
  drawText(large, "Hello, 123", 4, 4, kBlack, 2);
  EXPECT_NEAR(countDark(large), 4.0 * countDark(small), 0.25 * countDark(large));
}

TEST(Text, ShowsUmlautsAndGreek) {
  const auto drawn = [](const char* text) {
    Image image = page(30, 30, 255);
    drawText(image, text, 4, 4, kBlack, 1.5);
    return image;
  };
  std::set<std::vector<std::uint8_t>> seen;
  for (const char* text : {"u", "\u00fc", "\u03b8", "\u03b1", "\U0001F600"})
    EXPECT_TRUE(seen.insert(drawn(text).rgb).second) << text;
  EXPECT_EQ(drawn("\xff"), drawn("\uFFFD")) << "an invalid byte";
}

TEST(Utf8, KeepsValidTextAndMarksTheRest) {
  EXPECT_EQ(internal::charactersOf("a\u00fc\u20ac\U0001F600"), U"a\u00fc\u20ac\U0001F600");
  EXPECT_EQ(internal::charactersOf("\xff\xc3(\xe2\x82"), U"\uFFFD\uFFFD(\uFFFD\uFFFD");
  EXPECT_EQ(internal::charactersOf("\xc0\xaf"), U"\uFFFD\uFFFD") << "overlong";
  EXPECT_EQ(internal::charactersOf("\xed\xa0\x80"), U"\uFFFD\uFFFD\uFFFD") << "surrogate";
  EXPECT_EQ(internal::singleLine("a\nb\r\tc\x7f\u0085\u2028 \u00fc \xff"), "a b  c    \u00fc ?");
  EXPECT_EQ(internal::singleLine(std::string("x\0y", 3)), "x y");
}

}  // namespace rex::text_test
