#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "submission/graded_source.h"

namespace rex::submission::graded_part_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(GradedPart, KeepsWhatTheGraderCallsInItsPlace) {
  EXPECT_EQ(gradedSource("#include \"exercise.h\"\n"
                         "struct Point {\n  double x, y;\n};\n"
                         "namespace {\n"
                         "double shared(double a) { return a; }\n"
                         "void drawn() {\n  shared(1);\n}\n"
                         "}\n"
                         "void show(int a = 1) { drawn(); }\n"
                         "double helper(double a) { return shared(a); }\n"
                         "double graded(double a) { return helper(a); }  // kept\n"
                         "int main() { show(); graded(1); }\n",
                         {"graded"}, {}),
            "#include \"exercise.h\"\n"
            "struct Point {\n  double x, y;\n};\n"
            "namespace {\n"
            "double shared(double a) { return a; }\n"
            "              \n            \n \n"
            "}\n"
            "void show(int a = 1) ;           \n"
            "double helper(double a) { return shared(a); }\n"
            "double graded(double a) { return helper(a); }  // kept\n"
            "                                 \n");
}

TEST(GradedPart, KeepsWhatAnyOtherCodeMentions) {
  for (const char* user :
       {"#define CALL hidden()\n", "const auto kValue = hidden();\n",
        "struct A {\n  int f() { return hidden(); }\n};\n",
        "template <class T> int g(T) { return hidden(); }\n", "static int g() { return hidden(); }\n"})
    EXPECT_THAT(
        gradedSource(std::string(user) + "int hidden() { return 7; }\nint f() { return 1; }\nint main() {}\n",
                     {"f"}, {}),
        AllOf(HasSubstr("return 7"), HasSubstr("return 1"), Not(HasSubstr("main"))))
        << user;
}

TEST(GradedPart, KeepsFunctionsThatNobodyUses) {
  EXPECT_THAT(gradedSource("namespace {\nint unused() { return 2; }\nint drawn() { return 3; }\n}\n"
                           "int f() { return 1; }\nint main() { drawn(); }\n",
                           {"f"}, {}),
              AllOf(HasSubstr("return 2"), Not(HasSubstr("return 3"))));
}

TEST(GradedPart, IsEmptyWhereWhatIsWatchedIsLeftOut) {
  const std::string f = "int f() { return 1; }\n";
  for (const char* left :
       {"void asks() { solve(); }\nint main() { asks(); }\n", "#define ASK solve()\nint main() { ASK; }\n",
        "namespace {\nvoid asks() { rex::solve(); }\n}\nint main() { asks(); }\n"})
    EXPECT_EQ(gradedSource(f + left, {"f"}, {"solve"}), "") << left;
  for (const char* seen :
       {"int main() { solve(); }\n", "int asks() { return solve(); }\nstruct A { int a = asks(); };\n",
        "// solve\nvoid resolve() { f(); }\n"})
    EXPECT_NE(gradedSource(f + seen, {"f"}, {"solve"}), "") << seen;
}

TEST(GradedPart, TakesAnyText) {
  for (const char* text :
       {"", "}", "{", "namespace {", "int f() {", "#", "int f() {}}}}", "/*", "int g() {}"})
    EXPECT_NO_THROW(static_cast<void>(gradedSource(text, {"f"}, {"g"}))) << text;
  EXPECT_EQ(gradedSource("int g() { return 1; }", {"f"}, {}), "");
}

}  // namespace rex::submission::graded_part_test
