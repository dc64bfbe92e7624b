#include "base/text.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"

namespace rex::text_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Text, LosesItsBlanksAtBothEndsOnly) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \r\n"), "");
  const std::string_view text = "x = 1 ";
  EXPECT_EQ(columnIn(text, trimmed(text.substr(3))), 5) << "it is a part of the text";
  EXPECT_EQ(columnIn(text, trimmed(text.substr(5))), 7) << "even if nothing is left";
}

TEST(Text, LosesOneByteOrderMark) {
  EXPECT_EQ(withoutByteOrderMark("\xef\xbb\xbf\xef\xbb\xbf"
                                 "a"),
            "\xef\xbb\xbf"
            "a");
  EXPECT_EQ(withoutByteOrderMark("\xef\xbb"), "\xef\xbb");
}

TEST(Text, IsTakenApart) {
  EXPECT_THAT(splitAt("a,,b,", ','), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(splitAt("", ','), ElementsAre(""));
  EXPECT_THAT(splitWords(" a\tb\v\fc\r\n"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(splitWords("\n"), IsEmpty());
  EXPECT_THAT(splitList("1, 2 3,"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(splitList(",1, ,2"), ElementsAre("", "1", "", "2"));
  EXPECT_THAT(splitList(" "), IsEmpty());
  const std::string_view list = "10, 20 30";
  EXPECT_EQ(columnIn(list, splitList(list)[2]), 8);
}

// Streams of the standard library are another opinion.
TEST(Text, IsTakenApartAsByStreams) {
  Rng rng(3);
  for (int k = 0; k < 2000; ++k) {
    std::string text;
    for (int size = rng.index(12); size > 0; --size)
      text += "ab, \t\n"[static_cast<std::size_t>(rng.index(6))];
    std::vector<std::string> words, fields;
    std::istringstream byBlanks(text), byCommas(text + ",");
    for (std::string word; byBlanks >> word;) words.push_back(word);
    for (std::string field; std::getline(byCommas, field, ',');) fields.push_back(field);
    const auto ours = splitWords(text), parts = splitAt(text, ',');
    EXPECT_EQ(std::vector<std::string>(ours.begin(), ours.end()), words) << text;
    EXPECT_EQ(std::vector<std::string>(parts.begin(), parts.end()), fields) << text;
  }
}

TEST(Text, IsANumberAsAWholeOrNotAtAll) {
  EXPECT_EQ(parseNumber<int>("-12"), -12);
  EXPECT_EQ(parseNumber<int>("+12"), 12);
  EXPECT_EQ(parseNumber<double>("1e-3"), 0.001);
  EXPECT_EQ(parseNumber<std::uint64_t>("ff", 16), 255u);
  EXPECT_EQ(parseNumber<std::int64_t>("-9223372036854775808"), INT64_MIN);
  for (const char* text : {"", "+", "-", "+-1", "++1", " 1", "1 ", "1x", "x", "1.5", "2147483648"})
    EXPECT_EQ(parseNumber<int>(text), std::nullopt) << text;
  for (const char* text : {"", "+-1", "1,5", "0x1", "nan", "-inf", "Infinity", "1e999", "1e-999"})
    EXPECT_EQ(parseNumber<double>(text), std::nullopt) << text;
  EXPECT_EQ(parseNumber<unsigned>("-1"), std::nullopt);
}

TEST(Text, GivesBackTheNumbersThatWereWritten) {
  Rng rng(5);
  for (int k = 0; k < 2000; ++k) {
    const double number = rng.normal() * std::pow(10, rng.index(40) - 20);
    const std::string text = fmt::format("{}", number);
    EXPECT_EQ(parseNumber<double>(text), number) << text;
    EXPECT_EQ(parseNumber<double>(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Text, MayBeginWithANumber) {
  std::string_view text = "12/-3]";
  EXPECT_EQ(takeNumber<int>(text), 12);
  EXPECT_EQ(text, "/-3]");
  EXPECT_EQ(takeNumber<int>(text), std::nullopt);
  EXPECT_EQ(text, "/-3]") << "nothing is taken";
  text.remove_prefix(1);
  EXPECT_EQ(takeNumber<int>(text), -3);
  EXPECT_EQ(text, "]");
}

TEST(Text, MayBeANumeralThatIsNoFiniteNumber) {
  for (const char* text : {"1", "-1.5e3", "nan", "-inf", "Infinity", "1e999"})
    EXPECT_TRUE(isNumeral(text)) << text;
  for (const char* text : {"", "+1", "1x", "x", "1,2"}) EXPECT_FALSE(isNumeral(text)) << text;
}

TEST(Text, HoldsBytesAsDigits) {
  EXPECT_EQ(bytesOfHex("00ff7F"), std::string("\0\xff\x7f", 3));
  EXPECT_EQ(bytesOfHex(""), "");
}

TEST(Join, PutsTextBetweenNeighboursOnly) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(join(Texts{}, ", "), "");
  EXPECT_EQ(join(Texts{"a"}, ", "), "a");
  EXPECT_EQ(join(Texts{"a", "", "c"}, ", "), "a, , c");
}

TEST(Join, TakesAllKindsOfTexts) {
  const std::vector<std::string> texts{"one", "two", "three"};
  EXPECT_EQ(join(std::span(texts).first(2), " and "), "one and two");
  EXPECT_EQ(join(std::set<std::string>{"b", "a"}, ""), "ab");
  EXPECT_EQ(join(std::array{"x", "y"}, "; "), "x; y");
  EXPECT_EQ(join(std::vector<std::string_view>{"x", "y"}, "\n"), "x\ny");
}

TEST(LowerCase, ChangesTheCapitalsOfTheAlphabetOnly) {
  EXPECT_EQ(lowerCase("AbcXYZ[@`{ 09 \xc3\x84"), "abcxyz[@`{ 09 \xc3\x84");
  EXPECT_EQ(lowerCase(""), "");
}

TEST(EndingOf, HasItsPointAndSmallLetters) {
  EXPECT_EQ(endingOf("a/b.tar.GZ"), ".gz");
  EXPECT_EQ(endingOf("a.b/Arm.URDF"), ".urdf");
  for (const char* none : {"", "arm", "a.b/arm", ".ors", "a/..", "."}) EXPECT_EQ(endingOf(none), "") << none;
}

}  // namespace rex::text_test
