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

// The inside of the element.
std::string inside(std::string_view tex) {
  const std::string all = toMathMl(tex, false);
  const std::string_view open = "<math><mrow>", close = "</mrow></math>";
  EXPECT_TRUE(all.starts_with(open) && all.ends_with(close)) << all;
  return all.substr(open.size(), all.size() - open.size() - close.size());
}

TEST(TexMath, ReadsLettersNumbersAndSigns) {
  EXPECT_EQ(inside("x = 2.5y"), "<mi>x</mi><mo>=</mo><mn>2.5</mn><mi>y</mi>");
  EXPECT_EQ(inside("a<b-1."), "<mi>a</mi><mo>&#60;</mo><mi>b</mi><mo>−</mo><mn>1</mn><mo>.</mo>");
  EXPECT_EQ(inside("\\theta \\le \\infty"), "<mi>θ</mi><mo>≤</mo><mi>∞</mi>");
  EXPECT_EQ(inside("a/b"), "<mi>a</mi><mo stretchy=\"false\" lspace=\"0\" rspace=\"0\">/</mo><mi>b</mi>");
  EXPECT_EQ(inside("(x)"), "<mo stretchy=\"false\">(</mo><mi>x</mi><mo stretchy=\"false\">)</mo>");
  EXPECT_EQ(toMathMl("", true), "<math display=\"block\"><mrow></mrow></math>");
}

TEST(TexMath, ReadsScripts) {
  EXPECT_EQ(inside("x_1^2"), "<msubsup><mi>x</mi><mn>1</mn><mn>2</mn></msubsup>");
  EXPECT_EQ(inside("x^2_1"), inside("x_1^2"));
  EXPECT_EQ(inside("x^12"), "<msup><mi>x</mi><mn>1</mn></msup><mn>2</mn>") << "as TeX";
  EXPECT_EQ(inside("A^{-1}"), "<msup><mi>A</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>");
  EXPECT_EQ(inside("f'"), "<msup><mi>f</mi><mrow><mo>′</mo></mrow></msup>");
  EXPECT_THAT(inside("\\sum_{t=0}^H r_t"), HasSubstr("<munderover><mo>∑</mo>"));
  EXPECT_THAT(inside("\\int_0^1 x"), HasSubstr("<msubsup><mo>∫</mo>"));
}

TEST(TexMath, ReadsFractionsRootsAndAccents) {
  EXPECT_EQ(inside("\\frac{a}{b}"), "<mfrac><mrow><mi>a</mi></mrow><mrow><mi>b</mi></mrow></mfrac>");
  EXPECT_EQ(inside("\\frac12"), "<mfrac><mn>1</mn><mn>2</mn></mfrac>");
  EXPECT_EQ(inside("\\sqrt{2}"), "<msqrt><mrow><mn>2</mn></mrow></msqrt>");
  EXPECT_EQ(inside("\\ddot q"), "<mover accent=\"true\"><mi>q</mi><mo stretchy=\"false\">¨</mo></mover>");
}

TEST(TexMath, ReadsWordsAndAlphabets) {
  EXPECT_EQ(inside("\\text{if } x"), "<mtext>if </mtext><mi>x</mi>");
  EXPECT_EQ(inside("\\operatorname{tr}"), "<mi>tr</mi>");
  EXPECT_EQ(inside("\\mathbb{R}\\mathbb{E}\\mathcal{N}\\mathbf{I}"),
            "<mi>ℝ</mi><mi>𝔼</mi><mi>𝒩</mi><mi>𝐈</mi>");
  EXPECT_THAT(inside("\\sin x"), HasSubstr(">sin</mo><mi>x</mi>"));
  EXPECT_THAT(inside("\\min_i x_i"), ::testing::StartsWith("<munder><mo lspace"));
}

TEST(TexMath, ReadsBracketsAndMatrices) {
  EXPECT_THAT(inside("\\left(\\frac12\\right]"), HasSubstr("<mo stretchy=\"true\">]</mo>"));
  EXPECT_EQ(inside("\\left.x\\right|"), "<mrow><mrow><mi>x</mi></mrow><mo stretchy=\"true\">|</mo></mrow>");
  const std::string matrix = inside("\\begin{pmatrix}a & b \\\\ c & d\\end{pmatrix}");
  EXPECT_THAT(matrix,
              HasSubstr("<mtr><mtd><mrow><mi>a</mi></mrow></mtd><mtd><mrow><mi>b</mi></mrow></mtd></mtr>"
                        "<mtr><mtd><mrow><mi>c</mi>"));
  EXPECT_THAT(inside("\\begin{aligned}a &= b \\\\ &= c\\end{aligned}"),
              HasSubstr("<mtable class=\"aligned\">"));
}

TEST(TexMath, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const char* tex) { return static_cast<void>(toMathMl(tex, false)); };
  EXPECT_REX_ERROR(refused("a \\foo b"),
                   "cannot read the formula 'a \\foo b': found an unknown command at '\\foo b'");
  EXPECT_REX_ERROR(refused("a}"), "found something that nothing opened at '}'");
  EXPECT_REX_ERROR(refused("{a"), "found no } at ''");
  EXPECT_REX_ERROR(refused("x_1_2"), "found a second index at '2'");
  EXPECT_REX_ERROR(refused("x^1^2"), "found a second power at '2'");
  EXPECT_REX_ERROR(refused("x^"), "found no argument at ''");
  EXPECT_REX_ERROR(refused("x ? y"), "found an unknown sign at '? y'");
  EXPECT_REX_ERROR(refused("\\text{a"), "found no } at 'a'");
  EXPECT_REX_ERROR(refused("\\left( a"), "found no \\right at ''");
  EXPECT_REX_ERROR(refused("\\left"), "found no bracket at ''");
  EXPECT_REX_ERROR(refused("\\left\\foo"), "found no bracket at ''");
  EXPECT_REX_ERROR(refused("\\mathbb{r}"), "found a letter that is not a capital in another alphabet");
  EXPECT_REX_ERROR(refused("\\begin{table}\\end{table}"), "found an unknown environment");
  EXPECT_REX_ERROR(refused("\\begin{matrix}a\\end{cases}"), "found the end of another environment");
}

}  // namespace rex::reports::markdown_test
