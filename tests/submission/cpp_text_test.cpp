#include "submission/cpp_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::submission::cpp_text_test {

// "w:int n:12 t:"x" s:;", with a bar before each token that begins a line.
std::string tokens(std::string_view source) {
  const CppText text(source);
  std::string all;
  for (std::size_t i = 0; i < text.size(); ++i) {
    all += all.empty() ? "" : " ";
    all += text[i].startsLine ? "|" : "";
    all += "wnts"[static_cast<int>(text[i].kind)];
    all += ':';
    all += text.at(i);
  }
  return all;
}

TEST(CppText, KnowsItsTokens) {
  const std::pair<const char*, const char*> kTexts[] = {
      {"", ""},
      {"int a = 12;  // b\nc", "|w:int w:a s:= n:12 s:; |w:c"},
      {"a /* \n */ b /* open", "|w:a w:b"},
      {"/* a\n*/ # b", "|s:# w:b"},
      {"a // b \\\nc\nd", "|w:a |w:d"},
      {"'\"' '\\'' \"\\\"//\" x", "|t:'\"' t:'\\'' t:\"\\\"//\" w:x"},
      {"don't\nx", "|w:don t:'t |w:x"},
      {"\"a\\\nb\" x", "|t:\"a\\\nb\" w:x"},
      {"R\"(\")\" u8R\"x()\")x\" y", "|w:R t:\"(\")\" w:u8R t:\"x()\")x\" w:y"},
      {"R\"(open", "|w:R t:\"(open"},
      {"R \"(\" x", "|w:R t:\"(\" w:x"},
      {"R\"much too long for it()\" x", "|w:R t:\"much too long for it()\" w:x"},
      {"L'a' 0x1p-3 1'000 .5e+3f a.b 1..2", "|w:L t:'a' n:0x1p-3 n:1'000 n:.5e+3f w:a s:. w:b n:1..2"},
      {"a::b \xc3\xa4", "|w:a s:: s:: w:b s:\xc3 s:\xa4"}};
  for (const auto& [source, wanted] : kTexts) EXPECT_EQ(tokens(source), wanted) << source;
}

TEST(CppText, FindsThePartnersOfBrackets) {
  const CppText text("( [ ) ] { ( } (");
  EXPECT_EQ(text.partner(0), 2u);
  EXPECT_EQ(text.partner(3), 1u);
  EXPECT_EQ(text.partner(4), 6u);
  EXPECT_EQ(text.partner(5), text.size());
  EXPECT_EQ(text.partner(7), text.size());
  EXPECT_EQ(CppText(") (").partner(0), 2u);
}

TEST(CppText, KnowsWhereDirectivesEnd) {
  const CppText text("#define a \\\n  b\nc # d\n");
  EXPECT_TRUE(text.startsDirective(0));
  EXPECT_EQ(text.at(text.nextLine(0)), "c");
  EXPECT_FALSE(text.startsDirective(6));
  EXPECT_EQ(text.nextLine(6), text.size());
}

TEST(TextPlaces, CountFromOne) {
  const TextPlaces places("ab\n\nc");
  EXPECT_EQ(places.place(0), std::pair(1, 1));
  EXPECT_EQ(places.place(2), std::pair(1, 3));
  EXPECT_EQ(places.place(3), std::pair(2, 1));
  EXPECT_EQ(places.place(4), std::pair(3, 1));
  EXPECT_EQ(places.place(5), std::pair(3, 2));
}

TEST(Spliced, KeepsThePlaces) {
  const auto [text, places] = spliced("a\\\nb\\ \t\nc\\");
  EXPECT_EQ(text, "abc\\");
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 3, 8, 9}));
}

// The compiler's preprocessor is the second opinion: what it keeps has the same tokens as the source. All
// programs of the exercises are compared.
TEST(CppText, AgreesWithThePreprocessor) {
  const TemporaryFolder folder;
  int compared = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(homeFolder() / "exercises")) {
    if (entry.path().filename() != "solution.cpp" && entry.path().filename() != "check.cpp") continue;
    std::string source;  // directives would be carried out
    std::string text = readTextFile(entry.path());
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
      if (text[at] != '#') source += text.substr(at, end - at);
      at = end;
    }
    writeTextFile(folder.path() / "a.cpp", source);
    const ProcessResult run = runProcess({"g++", "-std=c++20", "-E", "-P", "-undef", "-w", "a.cpp"},
                                         {.directory = folder.path(), .outputLimit = 8u << 20});
    ASSERT_TRUE(run.ok()) << run.error;
    const auto flat = [](std::string one) {
      std::erase(one, '|');
      return one;
    };
    EXPECT_EQ(flat(tokens(source)), flat(tokens(run.output))) << entry.path();
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

}  // namespace rex::submission::cpp_text_test
