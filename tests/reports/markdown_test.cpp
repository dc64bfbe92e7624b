#include "reports/markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::reports::markdown_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::string same(const std::string& target) { return target; }

TEST(Markdown, BecomesHtmlWithAnchors) {
  const MarkdownPage page = markdownPage(
      "# A & B\n\nSome `x < 1`.\n\n## Part 1: one\n\n- a\n- b\n\n## Part 1: one\n\n| c | d |\n|---|---|\n| 1 "
      "| 2 |\n",
      same);
  EXPECT_THAT(page.html, HasSubstr("<h1 id=\"a--b\">A &amp; B</h1>"));
  EXPECT_THAT(page.html, HasSubstr("<h2 id=\"part-1-one\">Part 1: one</h2>"));
  EXPECT_THAT(page.html, HasSubstr("<h2 id=\"part-1-one-1\">Part 1: one</h2>"));
  EXPECT_THAT(page.html, HasSubstr("<td>1</td>"));
  ASSERT_EQ(page.sections.size(), 3u);
  EXPECT_EQ(page.sections[0].title, "A & B");
  EXPECT_EQ(page.sections[0].text, "Some x < 1 .");
  EXPECT_EQ(page.sections[1].text, "a b");
  EXPECT_EQ(page.sections[2].text, "c d 1 2");
  EXPECT_EQ(page.sections[2].level, 2);
}

TEST(Markdown, GivesLinksAndPicturesNewTargets) {
  const auto moved = [](const std::string& target) {
    return target == "a.md#b" ? "a.html#b" : target == "p.png" ? "q.png" : "";
  };
  const std::string html =
      markdownPage("[one `x`](a.md#b) and [two](src/c.h), ![picture](p.png)\n", moved).html;
  EXPECT_EQ(
      html,
      "<p><a href=\"a.html#b\">one <code>x</code></a> and two, <img src=\"q.png\" alt=\"picture\"></p>\n");
}

TEST(Markdown, KeepsTitlesAndMovesPicturesInLinks) {
  const auto moved = [](const std::string& target) { return target == "gone.md" ? "" : "to/" + target; };
  EXPECT_EQ(markdownPage("[![p](a.png)](b.md) [x](c.md \"t\")\n", moved).html,
            "<p><a href=\"to/b.md\"><img src=\"to/a.png\" alt=\"p\"></a> <a href=\"to/c.md\" "
            "title=\"t\">x</a></p>\n");
  EXPECT_EQ(markdownPage("[![p](a.png)](gone.md) ![q & r](gone.md)\n", moved).html,
            "<p><img src=\"to/a.png\" alt=\"p\"> q &amp; r</p>\n");
}

TEST(Markdown, DrawsFormulas) {
  EXPECT_EQ(markdownPage("# F\n\n$x<y$ and `$z$`\n\n$$\na \\, b\n$$\n", same).html,
            "<h1 id=\"f\">F</h1>\n<p><math><mrow><mi>x</mi><mo>&#60;</mo><mi>y</mi></mrow></math> and "
            "<code>$z$</code></p>\n<p><math display=\"block\"><mrow><mi>a</mi><mspace "
            "width=\"0.17em\"></mspace><mi>b</mi></mrow></math></p>\n");
  EXPECT_REX_ERROR(static_cast<void>(markdownPage("$\\foo$\n", same)), "cannot read the formula '\\foo'");
}

TEST(Markdown, ShowsHtmlAsText) {
  const std::string html =
      markdownPage("<script>alert(1)</script>\n\nand <b>this</b>, [x](javascript:alert)\n",
                   [](const std::string&) { return std::string(); })
          .html;
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, Not(HasSubstr("javascript:")));
}

TEST(Markdown, NamesAnchorsAsGitHubDoes) {
  EXPECT_EQ(headingAnchor("Part 3: resampling (7:23)"), "part-3-resampling-723");
  EXPECT_EQ(headingAnchor("A_b-c  d"), "a_b-c--d");
}

TEST(Markdown, TakesNothing) {
  EXPECT_EQ(markdownPage("", same).html, "");
  EXPECT_TRUE(markdownPage("no heading\n", same).sections.empty());
}

}  // namespace rex::reports::markdown_test
