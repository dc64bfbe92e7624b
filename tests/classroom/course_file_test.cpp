#include "classroom/course_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/instant.h"
#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::course_file_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CourseFileTest : public ::testing::Test {
 protected:
  static std::vector<submission::ExerciseInfo> exercises() {
    std::vector<submission::ExerciseInfo> all(2);
    all[0].name = "01-kinematics", all[1].name = "02-control";
    return all;
  }
  Course read(const std::string& text) const {
    writeTextFile(file(), text);
    return readCourse(file(), exercises());
  }
  std::string messageFor(const std::string& text) const {
    return messageOf([&] { return read(text); });
  }
  std::string file() const { return (folder_.path() / "course.toml").string(); }

  TemporaryFolder folder_;
};

TEST_F(CourseFileTest, ReadsRosterDatesAndWeights) {
  const Course course = read(R"(
title = "Robotics"
results = "results"
adjustments = "adjustments.toml"
[all]
percent_per_day = 10
[exercise.01-kinematics]
deadline = 2026-11-20T23:59:00+01:00
weight = 2.5
[exercise.01-kinematics.extensions]
pair = 2026-11-27T23:59:00+01:00
[exercise.02-control]
[[student]]
id = "zoe"
name = "Zoë Müller"
email = "zoe@uni.example"
group = "pair"
[[student]]
id = "adam"
group = "pair"
number = "4711"
section = "A"
)");
  EXPECT_EQ(course.title, "Robotics");
  EXPECT_EQ(course.results, folder_.path() / "results");
  EXPECT_EQ(course.adjustments, folder_.path() / "adjustments.toml");
  EXPECT_THAT(course.ids(), ElementsAre("adam", "zoe"));
  EXPECT_EQ(course.student("zoe")->email, "zoe@uni.example");
  EXPECT_EQ(course.student("adam")->number, "4711");
  EXPECT_EQ(course.student("nobody"), nullptr);
  EXPECT_EQ(shownName(*course.student("zoe")), "Zoë Müller");
  EXPECT_EQ(shownName(*course.student("adam")), "adam");
  EXPECT_THAT(course.groups(), ElementsAre("pair"));
  EXPECT_THAT(course.members("pair"), ElementsAre("adam", "zoe"));
  EXPECT_TRUE(course.members("").empty());
  EXPECT_EQ(course.weights.at("01-kinematics"), 250);
  EXPECT_EQ(course.weights.at("02-control"), 100);
  EXPECT_EQ(course.policy.at("02-control").perDay, 1000);
  EXPECT_EQ(instantText(*studentDeadline(course.policy.at("01-kinematics"), "adam")), "2026-11-27T22:59:00Z")
      << "an extension of the group";
}

TEST_F(CourseFileTest, HoldsWhatACourseIsGradedWith) {
  const GradingSettings all = read(
                                  "secret_file = \"s\"\nseed = 7\nlevel = 2\nevidence = true\n"
                                  "reports = [\"markdown\", \"junit\"]\n")
                                  .settings;
  EXPECT_EQ(all.secret, folder_.path() / "s");
  EXPECT_EQ(all.seed, 7u);
  EXPECT_EQ(all.level, 2);
  EXPECT_TRUE(all.evidence);
  EXPECT_EQ(all.reports, "markdown,junit");
  const GradingSettings none = read("").settings;
  EXPECT_FALSE(none.seed || none.level || none.evidence);
  EXPECT_THAT(messageFor("evidence = 1\n"),
              HasSubstr(":1:12: the course file: 'evidence': found 1, wanted true or false"));
  EXPECT_EQ(read("time_zone = \"Europe/Berlin\"\n").timeZone, "Europe/Berlin");
  EXPECT_THAT(messageFor("time_zone = \"Berlin\"\n"), HasSubstr("wanted a name such as Europe/Berlin"));
  EXPECT_THAT(messageFor("seed = -1\n"), HasSubstr("wanted a whole number from 0 to"));
}

TEST_F(CourseFileTest, ReadsStudentsFromATable) {
  writeTextFile(folder_.path() / "students.csv", "group,id,name,remark\nA,zoe,\"Müller, Zoë\",x\n,adam,,\n");
  const Course course = read("students = \"students.csv\"\n[[student]]\nid = \"bob\"\n");
  EXPECT_THAT(course.ids(), ElementsAre("adam", "bob", "zoe"));
  EXPECT_EQ(course.student("zoe")->name, "Müller, Zoë");
  EXPECT_EQ(course.student("zoe")->group, "A");
}

TEST_F(CourseFileTest, ReadsTheHeadingsOfThreeLanguages) {
  for (const char* headings :
       {"ID,Full name,Email address,Group,number", "Kennung,Name,E-Mail,Gruppe,Matrikelnummer",
        "Identifiant,Nom,Courriel,Groupe,Numéro d'étudiant"}) {
    writeTextFile(folder_.path() / "students.csv", std::string(headings) + "\nzoe,Zoë,z@x,A,17\n");
    const Course course = read("students = \"students.csv\"\n");
    const CourseStudent* zoe = course.student("zoe");
    ASSERT_NE(zoe, nullptr) << headings;
    EXPECT_EQ(zoe->name + zoe->email + zoe->group + zoe->number, "Zoëz@xA17") << headings;
  }
  writeTextFile(folder_.path() / "students.csv", "id,Gruppen\nzoe,A\n");
  EXPECT_THAT(
      messageFor("students = \"students.csv\"\n"),
      HasSubstr("students.csv:1: column 'Gruppen' of a table of students: found an unknown heading (did you "
                "mean 'Gruppe'?)"));
}

// A file of deadlines is a course file without students, and the other way round.
TEST_F(CourseFileTest, HoldsTheDeadlinesThatAFileOfDeadlinesHolds) {
  const std::string dates = "[exercise.01-kinematics]\ndeadline = 2026-11-20T23:59:00+01:00\nweight = 2\n";
  EXPECT_EQ(read(dates).policy.at("01-kinematics").deadline, 1795215540);
  writeTextFile(file(), "title = \"Robotics\"\n" + dates + "[[student]]\nid = \"zoe\"\n");
  const LatePolicy policy = readLatePolicy(file(), {"01-kinematics"});
  EXPECT_EQ(policy.at("01-kinematics").deadline, 1795215540);
}

TEST_F(CourseFileTest, NamesThePlaceOfWhatIsWrong) {
  const std::string at = file() + ":", zoe = "[[student]]\nid = \"zoe\"\n";
  EXPECT_THAT(messageFor("titel = \"x\"\n"),
              HasSubstr(at + "1:1: unknown key 'titel' in the course file: wanted"));
  EXPECT_THAT(messageFor("titel = \"x\"\n"), HasSubstr("did you mean 'title'?"));
  EXPECT_THAT(messageFor("[exercise.01-kinematic]\n"),
              HasSubstr("no exercise is called '01-kinematic' (did you mean '01-kinematics'?)"));
  EXPECT_THAT(messageFor("[[student]]\nname = \"Zoe\"\n"), HasSubstr("[[student]]: no 'id'"));
  EXPECT_THAT(messageFor("[[student]]\nid = \"a/b\"\n"),
              HasSubstr(at + "2:6: a student: 'id': found a slash"));
  EXPECT_THAT(messageFor(zoe + "mail = \"x\"\n"), HasSubstr("unknown key 'mail' in [[student]]"));
  EXPECT_THAT(messageFor(zoe + "name = \"\"\n"), HasSubstr("a string that is not empty"));
  EXPECT_THAT(messageFor(zoe + "name = \"Zoe\\nBcc: x\"\n"),
              HasSubstr("a student: 'name': found a line break or an invisible character, wanted one line"));
  EXPECT_THAT(
      messageFor(zoe + "[[student]]\nid = \"Zoe\"\n"),
      HasSubstr(at + "4:6: a second student with the id 'Zoe': wanted one; the first is at " + at + "2:6"));
  EXPECT_THAT(messageFor("[[student]]\nid = \"\u00C4nne\"\n[[student]]\nid = \"a\u0308nne\"\n"),
              HasSubstr("a second student with the id 'a\u0308nne'"))
      << "of one folder on some machines";
  EXPECT_THAT(messageFor(zoe + "email = \"a@b\"\n[[student]]\nid = \"adam\"\nemail = \"A@b\"\n"),
              HasSubstr("a second student with the e-mail 'A@b'"));
  EXPECT_THAT(messageFor(zoe + "[[student]]\nid = \"adam\"\ngroup = \"zoe\"\n"),
              HasSubstr(at + "2:6: the group 'zoe' is also the id of a student: wanted another name"));
  EXPECT_THAT(
      messageFor(zoe + "[exercise.02-control.extensions]\nzoo = 2026-11-20T23:59:00Z\n"),
      HasSubstr(at + "4:7: an extension for 'zoo': found nobody of this name on the roster, wanted the id "
                     "of a student, or a group (did you mean 'zoe'?)"));
  EXPECT_THAT(messageFor("[exercise.02-control]\nweight = 0\n"), HasSubstr("a number above 0"));
  EXPECT_THAT(messageFor("[exercise.02-control]\nweight = 0.001\n"),
              HasSubstr("'weight': wanted at least 0.01"));
  EXPECT_THAT(messageFor("[all]\nweight = 2\n"),
              HasSubstr(at + "2:10: [all]: 'weight': wanted a weight in the table of an exercise"));
  EXPECT_THAT(messageFor("students = \"none.csv\"\n"),
              HasSubstr(at + "1:12: no such table of students: found"));
  EXPECT_REX_ERROR((readCourse("none.toml", {})), "none.toml: no such file: wanted a course file");
}

TEST_F(CourseFileTest, NamesTheLineOfABrokenTable) {
  const std::string table = (folder_.path() / "students.csv").string(),
                    course = "students = \"students.csv\"\n";
  writeTextFile(table, "name,group\nZoe,A\n");
  EXPECT_THAT(
      messageFor(course),
      HasSubstr(table + ":1: not a table of students: found the columns name, group, wanted a column 'id'"));
  writeTextFile(table, "id,group\nzoe\n");
  EXPECT_THAT(messageFor(course), HasSubstr(table + ":2: not a table of students: found 1 fields, wanted 2"));
  writeTextFile(table, "id,group\n,A\n");
  EXPECT_THAT(messageFor(course), HasSubstr(table + ":2: a student: 'id': found none"));
  writeTextFile(table, "id\nzoe\nZOE\n");
  EXPECT_THAT(messageFor(course), HasSubstr(table + ":3: a second student with the id 'ZOE'"));
}

}  // namespace rex::classroom::course_file_test
