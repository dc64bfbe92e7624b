#include "classroom/adjustments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::adjustments_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class AdjustmentsTest : public ::testing::Test {
 protected:
  static std::vector<submission::ExerciseInfo> exercises() {
    std::vector<submission::ExerciseInfo> all(2);
    all[0].name = "01-kinematics", all[1].name = "02-control";
    return all;
  }
  Adjustments read(const std::string& text) const {
    writeTextFile(file(), text);
    const Course course{.students = {{.id = "adam", .group = "pair"}, {.id = "zoe", .group = "pair"}}};
    return readAdjustments(file(), course, exercises());
  }
  std::string messageFor(const std::string& text) const {
    return messageOf([&] { return read(text); });
  }
  std::string file() const { return (folder_.path() / "adjustments.toml").string(); }

  TemporaryFolder folder_;
};

const std::string kBy = "reason = \"spoke to me\"\nauthor = \"A. Tutor\"\ndate = 2026-12-01\n";
const std::string kHead = "[[adjustment]]\nexercise = \"01\"\n";

TEST_F(AdjustmentsTest, ReadsAdjustmentsAndComments) {
  const Adjustments all = read(kHead + "student = \"zoe\"\ncheck = \"hand\"\npoints = 2.5\n" + kBy + kHead +
                               "group = \"pair\"\nadd = -1\n" + kBy +
                               "[[comment]]\nstudent = \"zoe\"\nexercise = \"control\"\nline = 12\n"
                               "text = \"Well done.\"\nauthor = \"A. Tutor\"\n");
  ASSERT_EQ(all.adjustments.size(), 2u);
  const Adjustment& first = all.adjustments[0];
  EXPECT_THAT(first.students, ElementsAre("zoe"));
  EXPECT_EQ(first.exercise, "01-kinematics");
  EXPECT_EQ(first.check, "hand");
  EXPECT_EQ(first.points, 250);
  EXPECT_EQ(first.reason, "spoke to me");
  EXPECT_EQ(first.date, "2026-12-01");
  EXPECT_THAT(all.adjustments[1].students, ElementsAre("adam", "zoe"));
  EXPECT_EQ(all.adjustments[1].add, -100);
  ASSERT_EQ(all.comments.size(), 1u);
  EXPECT_EQ(all.comments[0].exercise, "02-control");
  EXPECT_EQ(all.comments[0].line, 12);
}

TEST_F(AdjustmentsTest, NamesThePlaceOfWhatIsWrong) {
  const std::string at = file() + ":", zoe = kHead + "student = \"zoe\"\n", add = "add = 1\n";
  EXPECT_THAT(messageFor("[[adjustments]]\n"),
              HasSubstr("unknown key 'adjustments' in the file of adjustments"));
  EXPECT_THAT(messageFor(zoe + "point = 1\n"), HasSubstr("unknown key 'point' in [[adjustment]]"));
  EXPECT_THAT(messageFor(kHead + add + kBy),
              HasSubstr(at + "2:12: whom it is about: found neither student nor group, wanted one of them"));
  EXPECT_THAT(messageFor(zoe + "group = \"pair\"\n" + add + kBy), HasSubstr("found both student and group"));
  EXPECT_THAT(messageFor(kHead + "student = \"zo\"\n" + add + kBy),
              HasSubstr(at + "3:11: no student 'zo': wanted the id of a student (did you mean 'zoe'?)"));
  EXPECT_THAT(messageFor(kHead + "group = \"pairs\"\n" + add + kBy),
              HasSubstr("no group 'pairs': wanted a group of the roster (did you mean 'pair'?)"));
  EXPECT_THAT(messageFor("[[adjustment]]\nstudent = \"zoe\"\nexercise = \"01-kinematic\"\n" + add + kBy),
              HasSubstr(at + "3:12: no exercise is called '01-kinematic'"));
  EXPECT_THAT(messageFor(zoe + kBy),
              HasSubstr("[[adjustment]]: found neither points nor add, wanted points = 3"));
  EXPECT_THAT(messageFor(zoe + "points = 1\n" + add + kBy), HasSubstr("found both points and add"));
  EXPECT_THAT(messageFor(zoe + "points = -1\n" + kBy),
              HasSubstr(at + "4:10: [[adjustment]]: 'points': found -1, wanted points from 0 on"));
  EXPECT_THAT(messageFor(zoe + "add = 2000\n" + kBy), HasSubstr("at most 1000"));
  EXPECT_THAT(messageFor(zoe + add + "author = \"A\"\ndate = 2026-12-01\n"), HasSubstr("no 'reason'"));
  EXPECT_THAT(messageFor(zoe + add + "author = \"A\"\nreason = \"x\"\ndate = \"today\"\n"),
              HasSubstr("a date without a time, such as 2026-11-20"));
  EXPECT_THAT(messageFor("[[comment]]\nstudent = \"zoe\"\nexercise = \"01\"\nline = 0\ntext = \"x\"\n"),
              HasSubstr(at + "4:8: [[comment]]: 'line': found 0, wanted a whole number from 1"));
  EXPECT_THAT(messageFor("[[comment]]\nstudent = \"zoe\"\nexercise = \"01\"\n"), HasSubstr("no 'text'"));
  EXPECT_REX_ERROR((readAdjustments("none.toml", {}, {})),
                   "none.toml: no such file: wanted a file of adjustments");
}

}  // namespace rex::classroom::adjustments_test
