#include "submission/regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::grading::regions_test {

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

TEST(StripSolution, SaysWhichMarkerIsWrongAndWhere) {
  const auto strip = [](const char* text) { return stripSolution(text, "s.cpp"); };
  EXPECT_REX_ERROR(strip("int a;\n// <solution a>\n"), "s.cpp:2: no '// </solution>' closes this");
  EXPECT_REX_ERROR(strip("// <solution>\n// </solution>\n"), "s.cpp:1: a solution without a name");
  EXPECT_REX_ERROR(strip("\n// <soluton a>\n"),
                   "s.cpp:2: unknown marker 'soluton': wanted one of solution, todo "
                   "(did you mean 'solution'?)");
  EXPECT_REX_ERROR(strip("// <solution a>\n// <solution b>\n"),
                   "s.cpp:2: 'solution' inside the solution opened in line 1: wanted '// </solution>' first");
  EXPECT_REX_ERROR(strip("// <solution a>\n// </solution>\n// <solution a>\n"),
                   "s.cpp:3: a second solution called 'a'");
  EXPECT_REX_ERROR(strip("// </solution>\n"), "s.cpp:1: '</solution>' closes nothing");
  EXPECT_REX_ERROR(strip("// <todo>\n"), "s.cpp:1: 'todo' out of place");
  EXPECT_REX_ERROR(strip("// <solution a>\n// <todo>\n// <todo>\n"), "s.cpp:3: 'todo' out of place");
  EXPECT_REX_ERROR(strip("// <solution a>\n// <todo>\n// </todo>\n"), "s.cpp:3: '</todo>' is not needed");
  EXPECT_REX_ERROR(strip("// <solution a>\n// <todo>\nreturn 0;\n// </solution>\n"),
                   "s.cpp:3: a todo line: wanted it to start with '//| '");
}

TEST(StripHidden, RemovesHiddenBlocks) {
  EXPECT_EQ(stripHidden("a();\n\n// <hidden>\nsecret();\n// </hidden>\n\nb();\n", "check.cpp"),
            "a();\n\nb();\n");
  EXPECT_REX_ERROR(stripHidden("// <hidden>\n", "check.cpp"), "check.cpp:1: no '// </hidden>' closes this");
  EXPECT_REX_ERROR(stripHidden("// <solution a>\n", "check.cpp"), "check.cpp:1: unknown marker 'solution'");
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
  EXPECT_REX_ERROR(hiddenBlocks("// <hidden>\n", "c.cpp"), "c.cpp:1: no '// </hidden>' closes this");
}

TEST(ComposeVariant, ReplacesTheNamedRegionOnly) {
  const WrongVariant variant = composeVariant(kSolution, "solution.cpp", R"(// caught by: area, size-grows
// shown by: area
// mistake: forgets pi.

// <solution area>
  return r * r;
// </solution>
)",
                                              "wrong/pi.cpp");
  EXPECT_THAT(variant.caughtBy, ElementsAre("area", "size-grows"));
  EXPECT_THAT(variant.shownBy, ElementsAre("area"));
  EXPECT_EQ(variant.mistake, "forgets pi.");
  EXPECT_EQ(variant.source, R"(#include "exercise.h"

double squareOfNumber(double x) { return x * x; }

double area(double r) {
  return r * r;
}

int main() { return area(1) > 0; }
)");
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
  EXPECT_REX_ERROR(referenceText("// <solution a>\n", "s.cpp"), "s.cpp:1: no '// </solution>' closes this");
}

TEST(ComposeVariant, SaysWhatIsMissing) {
  const auto compose = [](const char* wrong) {
    return composeVariant(kSolution, "solution.cpp", wrong, "w.cpp");
  };
  EXPECT_REX_ERROR(compose("// mistake: m\n"),
                   "w.cpp:1: no check is named: wanted '// caught by: CHECK, ...'");
  EXPECT_REX_ERROR(compose("// caught by: a\n"), "w.cpp:1: the mistake is not described");
  EXPECT_REX_ERROR(compose("// caught by: a\n// mistake: m\n"), "w.cpp:1: no region");
  EXPECT_REX_ERROR(compose("// caught by: a\n// mistake: begins here\n// and ends here\n"),
                   "w.cpp:3: the mistake goes on after its line");
  EXPECT_REX_ERROR(compose("// caught by: a\n// mistake: m\nint x;\n"), "w.cpp:3: code outside a region");
  EXPECT_REX_ERROR(compose("// caught by: a\n// mistake: m\n// <solution aera>\n// </solution>\n"),
                   "w.cpp:3: solution.cpp has no region 'aera' (did you mean 'area'?)");
  EXPECT_REX_ERROR(compose("// <todo>\n"), "w.cpp:1: unknown marker 'todo'");
}

}  // namespace rex::grading::regions_test
