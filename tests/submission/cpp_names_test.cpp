#include "submission/cpp_names.h"

#include <gtest/gtest.h>

namespace rex::submission::cpp_names_test {

using Place = std::pair<int, int>;
constexpr Place kNowhere{0, 0};

Place place(std::string_view source) { return onlyMention("rex::solveIk", CppText(source)); }

TEST(OnlyMentionOf, IsTheOneLineOutsideMain) {
  EXPECT_EQ(place("int f() {\n  return rex::solveIk(1);\n}\n"), Place(2, 15));
  EXPECT_EQ(place("int f() { return solveIk(1); }\nint main() { if (solveIk(2)) { return solveIk(3); } }\n"),
            Place(1, 18));
  EXPECT_EQ(place("int main();\nint main(int, char**) { solveIk(3); }\nint f() { return solveIk(1); }\n"),
            Place(3, 18));
}

TEST(OnlyMentionOf, IsNoCommentLiteralOrPartOfAWord) {
  EXPECT_EQ(place("// solveIk\n/* solveIk\n solveIk */ int a = 1'000;\nint b = solveIk(1);\n"), Place(4, 9));
  EXPECT_EQ(place("auto t = \"solveIk \\\" solveIk\"; char c = '\"';\nint b = solveIk(1);\n"), Place(2, 9));
  EXPECT_EQ(place("int mySolveIk, solveIks, solveIk2;\nint b = solveIk(1);"), Place(2, 9));
}

// What only looks like the beginning of a comment must not hide the lines behind it.
TEST(MacroDefinitionLineOf, IsNotMisledByLiterals) {
  for (const char* before :
       {R"_(const char* a = R"(" /* )";)_", R"_(const char* a = u8R"x()" /* )x";)_",
        R"_(wchar_t a[] = {L'"', L"/*"[0]};)_", R"_(int a = 0xF'F'F; char b = '"', c[] = "/*";)_",
        R"_(double a = 1e-3'0, b = .5'0; const char* c = "'/*";)_"})
    EXPECT_EQ(macroDefinitionLine("rex", std::string(before) + "\n#define rex mine\n//*/\n"), 2) << before;
  EXPECT_EQ(macroDefinitionLine("rex", "auto a = R\"(\n#define rex mine\n)\";\n"), 0);
  EXPECT_EQ(macroDefinitionLine("rex", "auto a = R\"(\n#define rex mine\n"), 0);
  EXPECT_EQ(macroDefinitionLine("rex", "int a = R\""), 0);
}

TEST(OnlyMentionOf, IsNothingWhereSeveralOrNoneAre) {
  EXPECT_EQ(place("int solveIk(int);\nint f() { return solveIk(1); }\n"), kNowhere);
  EXPECT_EQ(place("int main() { return solveIk(1); }\n"), kNowhere);
  EXPECT_EQ(place(""), kNowhere);
  EXPECT_EQ(place("int main() { \"open"), kNowhere);
  EXPECT_EQ(place("/* open"), kNowhere);
}

TEST(DefinitionLineOf, FindsTheBodyAmongDeclarationsAndCalls) {
  const std::string source = R"(#include "exercise.h"
// solveIk(q) {
Vec solveIk(const Vec& q);
void helper() {
  if (solveIk(q)) { return; }
  for (auto x : solveIk(q)) {}
  auto y = solveIk(q); {}
}
Vec solveIk(const Vec& q,
            double step = f(1)) noexcept {
  return q;
}
Vec mySolveIk(int) { return {}; }
)";
  const CppText text(source);
  EXPECT_EQ(definitionLine("solveIk", text), 9);
  EXPECT_EQ(definitionLine("helper", text), 4);
  EXPECT_EQ(definitionLine("step", text), 0);
  EXPECT_EQ(definitionLine("", text), 0);
  EXPECT_EQ(definitionLine("f", CppText("int f(")), 0);
}

TEST(StandardInputUse, IsTheFirstInCode) {
  EXPECT_EQ(standardInputUse(CppText("int a;\n  std::cin >> a;\ngetchar();\n")), std::pair(2, 8));
  EXPECT_EQ(standardInputUse(CppText("fgets(line, 9, stdin);")), std::pair(1, 16));
  EXPECT_EQ(standardInputUse(CppText("// std::cin\n\"scanf\"; int cinema; mystdin();")), std::pair(0, 0));
}

TEST(MacroDefinition, IsFoundHoweverItIsWritten) {
  for (const char* source : {"#define rex mine", "int a;\n  #  define\trex", "#define rex(x) x",
                             "%:define rex mine", "#/* a */define/* b */rex mine", "#/*\n*/define rex",
                             "#def\\\nine re\\  \nx mine", "#define \\\n rex mine\n"})
    EXPECT_GT(macroDefinitionLine("rex", source), 0) << source;
  EXPECT_EQ(macroDefinitionLine("rex", "int a;\n\n#def\\\nine rex mine\n"), 3);
  for (const char* source : {"", "define rex", "#define rexx", "#define a rex", "// #define rex",
                             "#undef rex", "\"#define rex\"", "define", "#define"})
    EXPECT_EQ(macroDefinitionLine("rex", source), 0) << source;
}

}  // namespace rex::submission::cpp_names_test
