#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/markdown.h"
#include "support/expect_error.h"

namespace rex::reports::tex_math_test {

using ::testing::HasSubstr;

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

}  // namespace rex::reports::tex_math_test
