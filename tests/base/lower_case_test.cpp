#include <gtest/gtest.h>

#include "base/text.h"

namespace rex::lower_case_test {

TEST(LowerCase, ChangesTheCapitalsOfTheAlphabetOnly) {
  EXPECT_EQ(lowerCase("AbcXYZ[@`{ 09 \xc3\x84"), "abcxyz[@`{ 09 \xc3\x84");
  EXPECT_EQ(lowerCase(""), "");
}

TEST(EndingOf, HasItsPointAndSmallLetters) {
  EXPECT_EQ(endingOf("a/b.tar.GZ"), ".gz");
  EXPECT_EQ(endingOf("a.b/Arm.URDF"), ".urdf");
  for (const char* none : {"", "arm", "a.b/arm", ".ors", "a/..", "."}) EXPECT_EQ(endingOf(none), "") << none;
}

}  // namespace rex::lower_case_test
