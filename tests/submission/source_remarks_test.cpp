#include "submission/source_remarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::submission::source_remarks_test {

using ::testing::HasSubstr;

std::string asking(const std::string& line) {
  const std::string source = line + "\n", text = withAutoQuestions(CppText(source));
  return text.empty() ? "" : text.substr(0, text.size() - 1);
}

TEST(AutoQuestions, FollowDeclarationsOnTheirLine) {
  EXPECT_EQ(asking("  auto b = A * x;"),
            "  auto b = A * x; static_assert(sizeof(::rex::guard::autoHolds(b)) == 1);");
  EXPECT_EQ(
      asking("const auto b = f(\"A\", {1, 2});  // twice"),
      "const auto b = f(\"A\", {1, 2}); static_assert(sizeof(::rex::guard::autoHolds(b)) == 1);  // twice");
}

TEST(AutoQuestions, LeaveOtherTextAlone) {
  for (const char* line :
       {"int b = 3;", "for (auto b = 0; b < 3; ++b) {", "auto& b = A;", "auto [a, b] = f();", "  auto b =",
        "auto b = [&](double t) {", "if (auto b = f()) return;", "auto f(int) -> double;", "// auto b = A;",
        "auto b = 'c';", "/*\nauto b = A;\n*/", "R\"(\nauto b = A;\n)\"", "auto b = A; int c;"})
    EXPECT_EQ(asking(line), "") << line;
  EXPECT_EQ(withAutoQuestions(CppText("")), "");
}

TEST(AutoQuestions, TellViewsOfAnswersFromThoseOfVariables) {
  for (const char* value : {"S.kinematicsPos(\"handR\").head(2)", "f(g(1), (2)).transpose()", "f() .array()"})
    EXPECT_THAT(asking("auto v = " + std::string(value) + ";"), HasSubstr("autoViews(v)")) << value;
  for (const char* value : {"x.head(2)", "A.transpose().row(1)", "(a + b).head(2)", "A.col(f(1)).head(2)"})
    EXPECT_THAT(asking("auto v = " + std::string(value) + ";"), HasSubstr("autoHolds(v)")) << value;
}

TEST(AutoAnswers, AreOurWordsAtTheDeclaration) {
  const std::string source = "int a;\n  auto b = A * x;\n";
  std::vector<grading::CompileDiagnostic> messages = {
      {"main.cpp", 2, 44, "warning", "-Wdeprecated-declarations",
       "'char rex::guard::autoHolds(const T&) [with T = ...]' is deprecated"},
      {"src/course/auto_guard.h", 30, 21, "note", "", "declared here: rex::guard::autoHolds"},
      {"main.cpp", 1, 5, "warning", "-Wunused-variable", "unused variable 'a'"}};
  explainAutoAnswers(messages, CppText(source));
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(
      toString(messages[0]),
      "main.cpp:2:3: warning: 'auto' makes 'b' an expression that refers to other values, which may be gone "
      "when it is used: write its type instead, such as Eigen::VectorXd b, or end it with .eval() "
      "[eigen-auto]");
  EXPECT_EQ(messages[1].line, 1);
}

TEST(IntegerDivision, IsNamedWithItsResult) {
  const auto found = integerDivisions(CppText("int a;\nx = 2 * (1 / 2) + 7/3;\n"), "main.cpp");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(toString(found[0]),
            "main.cpp:2:10: warning: 1 / 2 is 0, as both are whole numbers: write 1. / 2 [integer-division]");
  EXPECT_EQ(toString(found[1]),
            "main.cpp:2:19: warning: 7 / 3 is 2, as both are whole numbers: write 7. / 3 [integer-division]");
}

TEST(IntegerDivision, IsNotSeenInOtherText) {
  for (const char* line : {"x = 1. / 2;",
                           "x = 1 / 2.;",
                           "x = 4 / 2;",
                           "x = n / 2;",
                           "x = a1 / 2;",
                           "// 1 / 2",
                           "x = 3;  // slide 1/2",
                           "/* 1 / 2 */",
                           "print(\"1 / 2\");",
                           "x = 1 / 2e3;",
                           "x = 1 / 0;",
                           "x = 2.5 / 4;",
                           "#include <a 1/2>",
                           "x = 1 / 2_m;",
                           "x = 1 / 2.5;",
                           "/* a\n1 / 2\n*/",
                           "x = y / 1e-3 / 33;",
                           "x = y / 7 / 2;",
                           "#define A 1 / \\\n  2 + 1 / 2",
                           "x = 1'000 / 3;",
                           "x = 2.E+3 / 7;"})
    EXPECT_TRUE(integerDivisions(CppText(line), "main.cpp").empty()) << line;
  for (const char* line :
       {"/* a\n */ x = 1 / 2;", "x = e-3 / 2;", "f(\"half\", 1 / 2);", "x = 1 /* a */ / 2;"})
    EXPECT_EQ(integerDivisions(CppText(line), "main.cpp").size(), 1u) << line;
}

}  // namespace rex::submission::source_remarks_test
