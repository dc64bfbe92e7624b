#include "submission/regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::submission::regions_test {

using ::testing::ElementsAre;

constexpr std::string_view kSolution = R"(#include "exercise.h"

// <solution helper>
double squareOfNumber(double x) { return x * x; }
// </solution>

double area(double r) {
  // <solution area>
  const double square = squareOfNumber(r);
  return 3.14159265358979 * square;
  // <todo>
  //| // TODO: the area of a circle of radius `r`.
  //|
  //| if (r < 0) {
  //|   return -1;
  //| }
  //| return 0;
  // </solution>
}

int main() { return area(1) > 0; }
)";

TEST(StripSolution, KeepsTheTodoAndNothingOfTheSolution) {
  EXPECT_EQ(stripSolution(kSolution, "solution.cpp"), R"(#include "exercise.h"

double area(double r) {
  // TODO: the area of a circle of radius `r`.

  if (r < 0) {
    return -1;
  }
  return 0;
}

int main() { return area(1) > 0; }
)");
}

TEST(StripSolution, LeavesOrdinaryCommentsAlone) {
  const std::string text = "// a <solution> in words\n// x <y>\nint a;  // <solution b>\n";
  EXPECT_EQ(stripSolution(text, "s.cpp"), text);
}

// A malformed text, and the message about it.
struct Malformed {
  const char* text;
  const char* message;
};

TEST(StripSolution, SaysWhichMarkerIsWrongAndWhere) {
  constexpr Malformed kTexts[] = {
      {"int a;\n// <solution a>\n", "s.cpp:2:5: no '// </solution>' closes this"},
      {"// <solution>\n// </solution>\n",
       "s.cpp:1:5: a solution without a name: wanted '// <solution NAME>'"},
      {"\n  // <soluton a>\n",
       "s.cpp:2:7: unknown marker 'soluton': wanted one of solution, todo (did you mean 'solution'?)"},
      {"// <variant a>\n", "s.cpp:1:5: unknown marker 'variant': wanted one of solution, todo"},
      {"// <solution a>\n// <solution b>\n",
       "s.cpp:2:5: 'solution' inside the solution opened in line 1: wanted '// </solution>' first"},
      {"// <solution a>\n// </solution>\n// <solution a>\n", "s.cpp:3:14: a second solution called 'a'"},
      {"// </solution>\n", "s.cpp:1:6: '</solution>' closes nothing"},
      {"// <todo>\n", "s.cpp:1:5: 'todo' out of place: wanted one in a solution, after the reference lines"},
      {"// <solution a>\n// <todo>\n// <todo>\n",
       "s.cpp:3:5: 'todo' out of place: wanted one in a solution, after the reference lines"},
      {"// <solution a>\n// <todo>\n// </todo>\n",
       "s.cpp:3:6: '</todo>' is not needed: wanted '// </solution>', which ends both"},
      {"// <solution a>\n// <todo>\n  return 0;\n// </solution>\n",
       "s.cpp:3:3: a todo line: wanted it to start with '//| '"},
  };
  for (const auto& [text, message] : kTexts)
    EXPECT_EQ(messageOf([&] { return stripSolution(text, "s.cpp"); }), message);
}

TEST(StripHidden, RemovesHiddenBlocks) {
  EXPECT_EQ(stripHidden("a();\n\n// <hidden>\nsecret();\n// </hidden>\n\nb();\n", "check.cpp"),
            "a();\n\nb();\n");
  EXPECT_REX_ERROR(stripHidden("// <hidden>\n", "check.cpp"), "check.cpp:1:5: no '// </hidden>' closes this");
  EXPECT_REX_ERROR(stripHidden("// <solution a>\n", "check.cpp"), "check.cpp:1:5: unknown marker 'solution'");
}

TEST(Blocks, AreTheLinesThatStudentsDoNotGet) {
  const std::string text =
      "a();\n// <solution a>\n  int x;\n\n  x = 1;\n// <todo>\n//| x();\n// </solution>\n"
      "// <solution b>\n// why\n// </solution>\n";
  const auto blocks = solutionBlocks(text, "s.cpp");
  ASSERT_EQ(blocks.size(), 2u);
  ASSERT_EQ(blocks[0].size(), 3u);
  EXPECT_EQ(blocks[0][0].number, 3);
  EXPECT_EQ(blocks[0][0].text, "int x;");
  EXPECT_EQ(blocks[0][2].number, 5);
  EXPECT_EQ(blocks[0][2].text, "x = 1;");
  EXPECT_EQ(blocks[1][0].text, "// why");
  EXPECT_EQ(textOutsideRegions(text, "s.cpp"), "a();\n");
  const auto hidden = hiddenBlocks("a();\n// <hidden>\nb();\n// </hidden>\n", "c.cpp");
  ASSERT_EQ(hidden.size(), 1u);
  EXPECT_EQ(hidden[0][0].number, 3);
  EXPECT_EQ(hidden[0][0].text, "b();");
  EXPECT_REX_ERROR(hiddenBlocks("// <hidden>\n", "c.cpp"), "c.cpp:1:5: no '// </hidden>' closes this");
}

constexpr std::string_view kWrong = R"(// Mistakes with circles.

// <variant forgets_pi>
// caught by: area, size-grows
// shown by: area
// mistake: forgets pi.
// ask: Where is pi?
// ask: It is missing.
// <solution area>
  const double square = r * r;

  return square;

// <variant cubes> caught by: area
// mistake: cubes, and so: wrong.
// <solution helper>
double squareOfNumber(double x) { return x * x * x; }
// <solution area>

)";

TEST(ReadVariants, ReplacesTheNamedRegionsOnly) {
  const std::vector<WrongVariant> variants = readVariants(kSolution, "solution.cpp", kWrong, "wrong.cpp");
  ASSERT_EQ(variants.size(), 2u);
  EXPECT_EQ(variants[0].name, "forgets_pi");
  EXPECT_THAT(variants[0].caughtBy, ElementsAre("area", "size-grows"));
  EXPECT_THAT(variants[0].shownBy, ElementsAre("area"));
  EXPECT_EQ(toString(variants[0].namedAt.at("size-grows")), "wrong.cpp:4:21");
  EXPECT_EQ(variants[0].mistake, "forgets pi.");
  EXPECT_EQ(variants[0].question, "Where is pi? It is missing.");
  EXPECT_EQ(variants[0].source, R"(#include "exercise.h"

double squareOfNumber(double x) { return x * x; }

double area(double r) {
  const double square = r * r;

  return square;
}

int main() { return area(1) > 0; }
)");
  EXPECT_EQ(variants[1].name, "cubes");
  EXPECT_THAT(variants[1].caughtBy, ElementsAre("area"));
  EXPECT_THAT(variants[1].shownBy, ElementsAre());
  EXPECT_EQ(variants[1].mistake, "cubes, and so: wrong.");
  EXPECT_EQ(variants[1].question, "");
  EXPECT_EQ(variants[1].source, R"(#include "exercise.h"

double squareOfNumber(double x) { return x * x * x; }

double area(double r) {
}

int main() { return area(1) > 0; }
)");
}

// The region of the solution has the lines a to f, and a variant begins before `region`.
std::string composedWith(const std::string& region) {
  const std::string solution =
      "// <solution x>\n  a1();\n  a2();\n  for (b)\n    c();\n  }\n\n  f();\n// </solution>\n";
  const auto variants =
      readVariants(solution, "s.cpp",
                   "// <variant v>\n// caught by: c\n// mistake: m\n// <solution x>\n" + region, "w.cpp");
  return variants.at(0).source;
}

TEST(ReadVariants, ReplacesPassagesOfARegion) {
  EXPECT_EQ(composedWith("// in place of: a2();\nz();\n\n"),
            "  a1();\nz();\n  for (b)\n    c();\n  }\n\n  f();\n");
  EXPECT_EQ(composedWith("// in place of: a1\n\n  // in place of: for ... }\ny();\n\nz();\n"),
            "  a2();\ny();\n\nz();\n\n  f();\n");
  EXPECT_EQ(composedWith("// in place of: a1 ... f();\n"), "");
}

TEST(ReadVariants, SaysWhichPassageIsNotThere) {
  const Malformed kTexts[] = {
      {"z();\n// in place of: a1\n",
       "w.cpp:6:1: code before 'in place of': wanted 'in place of' first, or nowhere in a region"},
      {"// in place of:\n",
       "w.cpp:5:1: no lines begin with '': wanted the beginning of one line of region 'x'"},
      {"// in place of: a3\n",
       "w.cpp:5:17: no lines begin with 'a3': wanted the beginning of one line of region 'x'"},
      {"// in place of: a\n",
       "w.cpp:5:17: 2 lines begin with 'a': wanted the beginning of one line of region 'x'"},
      {"// in place of: c ... a1\n",
       "w.cpp:5:23: no line after that begins with 'a1': wanted the beginning of one line of region 'x'"},
      {"// in place of: c\n// in place of: a1\n",
       "w.cpp:6:17: 'a1' comes before what was replaced last: wanted passages in the order of the solution"},
      {"// in place of: a1 ... c\n// in place of: a2\n",
       "w.cpp:6:17: 'a2' comes before what was replaced last: wanted passages in the order of the solution"},
  };
  for (const auto& [text, message] : kTexts)
    EXPECT_EQ(messageOf([&] { return composedWith(text); }), message);
}

TEST(ReadVariants, SaysWhatIsWrongAndWhere) {
  constexpr Malformed kTexts[] = {
      {"", "w.cpp:1:1: no variant: wanted '// <variant NAME>'"},
      {"// words\nint x;\n",
       "w.cpp:2:1: code before the first variant: wanted '// <variant NAME>' before it"},
      {"// <solution area>\n",
       "w.cpp:1:1: code before the first variant: wanted '// <variant NAME>' before it"},
      {"// <variant>\n", "w.cpp:1:5: a variant without a name: wanted '// <variant NAME>'"},
      {"// <variant a b>\n", "w.cpp:1:13: a variant called 'a b': wanted letters, digits and '_' only"},
      {"// <variant a>\n// </variant>\n",
       "w.cpp:2:6: '</variant>' is not needed: wanted a line '// <solution NAME>' or '// <variant NAME>', or "
       "the end of the file"},
      {"// <variant a>\n// <solution area>\n  // </solution>\n",
       "w.cpp:3:8: '</solution>' is not needed: wanted a line '// <solution NAME>' or '// <variant NAME>', "
       "or "
       "the end of the file"},
      {"// <varaint a>\n",
       "w.cpp:1:5: unknown marker 'varaint': wanted one of variant, solution (did you mean 'variant'?)"},
      {"// <variant a>\n// caught by: area\n// mistake: m\n// <solution area>\n// <variant a>\n",
       "w.cpp:5:13: a second variant called 'a'"},
      {"// <variant a>\n// <solution area>\n// <todo>\n",
       "w.cpp:3:5: unknown marker 'todo': wanted one of variant, solution"},
      {"// <variant a>\n// <solution area>\n// <solution area>\n",
       "w.cpp:3:14: a second solution called 'area'"},
      {"// <variant a>\n// mistake: m\n// <solution area>\n",
       "w.cpp:1:13: variant 'a': no check is named: wanted '// caught by: CHECK, ...'"},
      {"// <variant a>\n// caught by: ,\n// mistake: m\n// <solution area>\n// <variant b>\n",
       "w.cpp:1:13: variant 'a': no check is named: wanted '// caught by: CHECK, ...'"},
      {"// <variant a>\n// caught by: area\n// <solution area>\n",
       "w.cpp:1:13: variant 'a': the mistake is not described: wanted '// mistake: TEXT'"},
      {"\n// <variant a>\n// caught by: area\n// mistake: m\n",
       "w.cpp:2:13: variant 'a': no region: wanted '// <solution NAME>' with the mistake"},
      {"// <variant a>\n// caugth by: area\n",
       "w.cpp:2:4: unknown line 'caugth by' in a variant: wanted one of 'caught by:', 'shown by:', "
       "'mistake:' and 'ask:', each in one line (did you mean 'caught by'?)"},
      {"// <variant a> caugth by: area\n",
       "w.cpp:1:16: unknown line 'caugth by' in a variant: wanted one of 'caught by:', 'shown by:', "
       "'mistake:' and 'ask:', each in one line (did you mean 'caught by'?)"},
      {"// <variant a>\n// mistake: begins here\n// and ends here\n",
       "w.cpp:3:4: unknown line 'and ends here' in a variant: wanted one of 'caught by:', 'shown by:', "
       "'mistake:' and 'ask:', each in one line"},
      {"// <variant a>\n// mistake: m\n// mistake: n\n",
       "w.cpp:3:4: a second line for the mistake: wanted '// mistake: TEXT' in one line"},
      {"// <variant a>\n// caught by: area\n// mistake: m\n// ask: Is it r\n// <solution area>\n",
       "w.cpp:1:13: variant 'a': the question has no '?': wanted '// ask: QUESTION?'"},
      {"// <variant a>\n//\n// mistake: m\n  int x;\n",
       "w.cpp:4:3: code outside a region: wanted '// <solution NAME>' before it"},
      {"// <variant a>\n// <solution aera>\n",
       "w.cpp:2:14: solution.cpp has no region 'aera' (did you mean 'area'?)"},
      {"// <variant a>\n// <solution area>\nreturn r;\n  //caught by: area\n",
       "w.cpp:4:3: 'caught by' after a region: wanted it below '// <variant NAME>'"},
  };
  for (const auto& [text, message] : kTexts)
    EXPECT_EQ(messageOf([&] { return readVariants(kSolution, "solution.cpp", text, "w.cpp"); }), message);
}

TEST(VariantNames, AreThoseOfAllSectionsWhateverIsWrongWithThem) {
  EXPECT_THAT(variantNamesIn(kWrong), ElementsAre("forgets_pi", "cubes"));
  EXPECT_THAT(variantNamesIn("// <variant b> x\nint x;\n// <variant>\n// </variant>\n// <variant a>\n"),
              ElementsAre("b", "a"));
}

TEST(VariantBlocks, AreTheLinesOfEachVariant) {
  const auto blocks = variantBlocks(kWrong, "w.cpp");
  ASSERT_EQ(blocks.size(), 2u);
  ASSERT_EQ(blocks[0].size(), 9u) << "with the blank lines";
  EXPECT_EQ(blocks[0][0].number, 4);
  EXPECT_EQ(blocks[0][0].text, "// caught by: area, size-grows");
  EXPECT_EQ(blocks[0][5].text, "const double square = r * r;");
  EXPECT_EQ(blocks[1][1].number, 17);
}

TEST(ReferenceText, IsTheSolutionWithoutMarkersAndTodos) {
  EXPECT_EQ(referenceText(kSolution, "solution.cpp"), R"(#include "exercise.h"

double squareOfNumber(double x) { return x * x; }

double area(double r) {
  const double square = squareOfNumber(r);
  return 3.14159265358979 * square;
}

int main() { return area(1) > 0; }
)");
  EXPECT_REX_ERROR(referenceText("// <solution a>\n", "s.cpp"), "s.cpp:1:5: no '// </solution>' closes this");
}

}  // namespace rex::submission::regions_test
