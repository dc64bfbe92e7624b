#include "base/escape.h"

#include <array>
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

}  // namespace rex::escape_test
