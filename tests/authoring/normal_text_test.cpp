#include <gtest/gtest.h>

#include "authoring/leak_scan.h"

namespace rex::authoring::normal_text_test {

std::string letters(std::string_view text, Comments comments = Comments::kKeep) {
  return normalText(text, comments).letters;
}

TEST(NormalText, KnowsNoLayoutAndNoCase) {
  for (const char* text : {"x = A * b;", "X=a*B;", "  x\t=\n\r\n A *\n b ;", "// x = A\n//   * b;",
                           "/* x = A */ * /* b; */", "x = A \\\n * b;", "x =\\n A\\t * b;", "\x01x = A * b;"})
    EXPECT_EQ(letters(text), "x=a*b;") << text;
}

TEST(NormalText, DropsCommentsWhereAsked) {
  for (const char* text :
       {"x = A /* why */ * b; // because", "// why\nx =\n// why\nA * b;", "x = A * b; /* open"})
    EXPECT_EQ(letters(text, Comments::kDrop), "x=a*b;") << text;
  EXPECT_EQ(letters("// only\n/**/", Comments::kDrop), "");
  EXPECT_EQ(letters("a / b * c", Comments::kDrop), "a/b*c");
}

TEST(NormalText, ReadsEscapesEntitiesAndWideText) {
  EXPECT_EQ(letters("if (a &lt; b &amp;&amp; c &gt; d) &quot;&#39;"), "if(a<b&&c>d)\"'");
  EXPECT_EQ(letters("a &#60; b &#38;&#38; c &#62; d &#34;"), "a<b&&c>d\"") << "as htmlText() writes it";
  EXPECT_EQ(letters(R"({"code": "say(\"hello\");\n"})"), R"({"code":"say("hello");"})");
  EXPECT_EQ(letters(std::string_view("x\0 \0=\0A\0", 8)), "x=a");
  EXPECT_EQ(letters("&lt"), "&lt");
}

TEST(NormalText, TellsTheLineOfEachLetter) {
  const NormalText text = normalText("a\n/* b\nc */ d\\\ne\n", Comments::kDrop);
  EXPECT_EQ(text.letters, "ade");
  EXPECT_EQ(text.lines, (std::vector<int>{1, 3, 4}));
  EXPECT_TRUE(normalText("", Comments::kKeep).letters.empty());
}

}  // namespace rex::authoring::normal_text_test
