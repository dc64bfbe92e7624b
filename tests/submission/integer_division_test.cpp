#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "submission/source_remarks.h"

namespace rex::submission::integer_division_test {

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

}  // namespace rex::submission::integer_division_test
