#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::error_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SourceLocation, PrintsOnlyWhatIsKnown) {
  EXPECT_EQ(toString(SourceLocation{}), "");
  EXPECT_EQ(toString(SourceLocation{"arm.ors"}), "arm.ors");
  EXPECT_EQ(toString(SourceLocation{"arm.ors", 12}), "arm.ors:12");
  EXPECT_EQ(toString(SourceLocation{"arm.ors", 12, 3}), "arm.ors:12:3");
}

TEST(Error, JoinsItsParts) {
  EXPECT_STREQ(Error({.what = "no scene"}).what(), "no scene");
  EXPECT_STREQ(Error({.what = "joint 'elbow': unknown parent",
                      .where = {"arm.ors", 12, 8},
                      .found = "'upArm'",
                      .wanted = "an earlier body",
                      .nearest = {"upArmL", "upArmR"}})
                   .what(),
               "arm.ors:12:8: joint 'elbow': unknown parent: found 'upArm', wanted an earlier body "
               "(did you mean 'upArmL' or 'upArmR'?)");
  EXPECT_STREQ(Error({.what = "mass", .wanted = "a number"}).what(), "mass: wanted a number");
}

TEST(NearestNames, FindsTyposCaseAndPrefixes) {
  const std::vector<std::string> known = {"waist", "handL", "handR", "head", "upArmL"};
  EXPECT_THAT(nearestNames("handr", known), ElementsAre("handR", "handL"));
  EXPECT_THAT(nearestNames("wiast", known), ElementsAre("waist"));
  EXPECT_THAT(nearestNames("wisat", known), IsEmpty());  // two edits in five letters are too many
  EXPECT_THAT(nearestNames("upArm", known), ElementsAre("upArmL"));
  EXPECT_THAT(nearestNames("gripper", known), IsEmpty());
  EXPECT_THAT(nearestNames("", known), IsEmpty());
  EXPECT_THAT(nearestNames(std::string(100000, 'x'), known), IsEmpty());
}

TEST(RequireSize, NamesBothSizes) {
  EXPECT_NO_THROW(requireSize("joint angles", 7, 7));
  try {
    requireSize("joint angles", 5, 7);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "joint angles: found a vector of size 5, wanted size 7");
  }
}

TEST(Diagnostic, PrintsItsPlace) {
  EXPECT_EQ(toString(Diagnostic{{"arm.ors", 3, 1}, "agent is ignored"}),
            "arm.ors:3:1: note: agent is ignored");
  EXPECT_EQ(toString(Diagnostic{{}, "agent is ignored"}), "note: agent is ignored");
  EXPECT_EQ(toString(Diagnostic{{"arm.urdf", 7, 3}, "unknown tag", Severity::kWarning}),
            "arm.urdf:7:3: warning: unknown tag");
}

}  // namespace rex::error_test
