#include "base/escape.h"

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/rng.h"

namespace rex::escape_test {

// Texts that try to be something else than text.
const std::vector<std::string> kHostile = {"\u202Edrowssap",     "\u2066x\u2069", "a\u200Bb", "a\u2028b",
                                           "a\u2029b",           "a\u0085b",      "\xff\xc3", "\x1b[2J",
                                           "\x1b]0;x\x07",       "\r::error::",   "\uFEFF",   "\U000E0041",
                                           std::string(1, '\0'), "\u00AD"};

// What no output of an escaper may hold: bytes of C0 and DEL but newline and tab, and the hostile characters.
std::string forbiddenIn(const std::string& text) {
  for (const unsigned char c : text)
    if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7F) return "a control character";
  for (const char* piece : {"\u202E", "\u2066", "\u2069", "\u200B", "\u2028", "\u2029", "\u0085", "\xff",
                            "\uFEFF", "\U000E0041", "\u00AD"})
    if (text.find(piece) != std::string::npos) return piece;
  return {};
}

TEST(Escape, ShowsHostileTextInEveryMedium) {
  using Escaper = std::string (*)(std::string_view);
  constexpr std::array<Escaper, 8> kEscapers = {xmlText,  htmlText,       markdownText,    markdownBlock,
                                                csvField, commandMessage, commandProperty, terminalText};
  for (std::size_t k = 0; k < kEscapers.size(); ++k)
    for (const std::string& text : kHostile)
      EXPECT_EQ(forbiddenIn(kEscapers[k]("a" + text + "b")), "") << "escaper " << k;
}

TEST(Escape, LeavesNoMarkup) {
  EXPECT_EQ(xmlText("]]><b a=\"'\">&\n"), "]]&#62;&#60;b a=&#34;'&#34;&#62;&#38;&#10;");
  EXPECT_EQ(htmlText("<b a='`\">&"), "&#60;b a=&#39;&#96;&#34;&#62;&#38;");
  EXPECT_EQ(markdownText("a|b\n# *x* http://a www.b"), "a&#124;b &#35; &#42;x&#42; http&#58;//a www&#46;b");
  EXPECT_EQ(markdownBlock("</pre>\n::error::x ##[error] ##vso[x]"),
            "&#60;/pre&#62;\n&#58;:error&#58;:x &#35;#[error] &#35;#vso[x]");
  EXPECT_EQ(commandMessage("a%0A\n::error::x"), "a%250A%0A::error::x");
  EXPECT_EQ(commandProperty("a,b:c\n%"), "a%2Cb%3Ac%0A%25");
}

TEST(Escape, KeepsTheColoursOfRexAlone) {
  EXPECT_EQ(terminalText("\033[32m ok \033[0m\033[31;1mx\033[2Jy\033"),
            "\033[32m ok \033[0m\uFFFD[31;1mx\uFFFD[2Jy\uFFFD");
}

TEST(Escape, KeepsTheValuesOfJson) {
  for (const std::string& text : kHostile) {
    const bool isJson = text != "\xff\xc3";  // the library takes no other bytes
    const nlohmann::json value = {{"a", isJson ? text : "\u202E\U000E0041"}};
    const std::string shown = visibleJson(value.dump());
    EXPECT_EQ(forbiddenIn(shown), "");
    EXPECT_EQ(nlohmann::json::parse(shown), value);
  }
}

// Python reads XML and HTML by rules of its own.
TEST(Escape, IsReadBackByOthers) {
  Rng rng(3);
  const std::vector<std::string> pieces = {"<",    ">",  "&",  "\"",     "'", "`",   "]]>",
                                           "&#0;", "\n", "\t", "\u00e4", "x", "<!--"};
  nlohmann::json all = nlohmann::json::array();
  for (int k = 0; k < 500; ++k) {
    std::string text;
    for (int i = rng.index(8); i > 0; --i)
      text += pieces[static_cast<std::size_t>(rng.index(static_cast<int>(pieces.size())))];
    all.push_back({text, xmlText(text), htmlText(text)});
  }
  const ProcessResult python =
      runProcess({"python3", "-c",
                  "import html, json, sys, xml.etree.ElementTree as E\n"
                  "for t, x, h in json.load(sys.stdin):\n"
                  "    e = E.fromstring(f'<a b=\"{x}\">{x}</a>')\n"
                  "    assert (e.text or '') == t and e.get('b') == t and html.unescape(h) == t, t\n"},
                 {.input = all.dump()});
  if (!python.started) GTEST_SKIP() << "python3 is not installed";
  EXPECT_TRUE(python.ok()) << python.error;
}

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

// What Persian, Sinhala, Japanese and emoji are written with; never two in a row, and never in other scripts.
TEST(Printable, KeepsTheJoinersThatAScriptNeeds) {
  for (const char* text : {"\u0639\u0644\u06CC\u200C\u0631\u0636\u0627", "\u0DC1\u0DCA\u200D\u0DBB\u0DD3",
                           "\u845B\U000E0100", "\u2764\uFE0F\u200D\U0001F525", "\u1820\u180E\u1820"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(htmlText(text), text);
    EXPECT_EQ(csvField(text), text);
    EXPECT_EQ(markdownText(text), text);
    EXPECT_EQ(cleanName(text).text, text);
  }
  EXPECT_EQ(printable("a\u200Cb\uFE0F"), "a" + kMark + "b" + kMark);
  EXPECT_EQ(printable("\u0628\u200C\u200C\u0628"), "\u0628\u200C" + kMark + "\u0628");
  EXPECT_EQ(printable(kMark + "\u200D"), kMark + kMark);
  EXPECT_EQ(printable("\u0628\u202E\u200C"), "\u0628" + kMark + kMark);
}

TEST(CleanName, LosesWhatNobodySees) {
  const CleanName name = cleanName(" \uFEFFZo\u00ADe\u200B \u200CM\u200E\u200F.\u00AD ");
  EXPECT_EQ(name.text, "Zoe M.");
  EXPECT_EQ(name.lost, (std::set<std::string>{"U+00AD", "U+200B", "U+200C", "U+200E", "U+200F", "U+FEFF"}));
  EXPECT_EQ(cleanName("\u200B").text, "");
  EXPECT_EQ(cleanName("a\u202Eb\xff").text, "a\u202Eb\xff") << "a fault to be told";
  EXPECT_TRUE(cleanName("Änne, O'Hara").lost.empty());
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

}  // namespace rex::escape_test
