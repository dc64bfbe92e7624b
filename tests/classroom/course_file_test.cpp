#include "classroom/course_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/instant.h"
#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::course_file_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CourseFileTest : public ::testing::Test {
 protected:
  static std::vector<submission::ExerciseInfo> exercises() {
    std::vector<submission::ExerciseInfo> all(2);
    all[0].name = "01-kinematics", all[1].name = "02-control";
    all[0].parts.resize(2);
    all[0].parts[0].id = "maps", all[0].parts[1].id = "step";
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
  EXPECT_EQ(course.exercise("01-kinematics").weight, 250);
  EXPECT_EQ(course.exercise("02-control").weight, 100);
  EXPECT_EQ(course.policy.at("02-control").perDay, 1000);
  EXPECT_EQ(instantText(*studentDeadline(course.policy.at("01-kinematics"), "adam")), "2026-11-27T22:59:00Z")
      << "an extension of the group";
}

TEST_F(CourseFileTest, SaysWhatEachExerciseCountsForAndWhoPasses) {
  const Course course = read(R"(
[all]
minimum_percent = 40
[total]
best = 1
pass_percent = 50.5
pass_exercises = 1
[exercise.01-kinematics]
parts = ["step"]
minimum_percent = 30
[exercise.02-control]
bonus = true
)");
  const CourseExercise first = course.exercise("01-kinematics"), second = course.exercise("02-control");
  EXPECT_TRUE(first.counts("step") && !first.counts("maps") && !first.isBonus);
  EXPECT_EQ(first.minimum, 3000) << "instead of that of all";
  EXPECT_TRUE(second.isBonus && second.counts("any"));
  EXPECT_FALSE(second.minimum.has_value()) << "nobody needs a bonus";
  EXPECT_EQ(course.total.best, 1);
  EXPECT_EQ(course.total.passPercent, 5050);
  EXPECT_EQ(course.total.passExercises, 1);
  EXPECT_TRUE(course.hasPassRules());
  EXPECT_FALSE(read("[exercise.02-control]\n").hasPassRules());
}

TEST_F(CourseFileTest, RefusesRulesThatNobodyCanMeet) {
  const std::string at = file() + ":", first = "[exercise.01-kinematics]\n",
                    second = "[exercise.02-control]\n";
  const std::pair<std::string, std::string> files[] = {
      {first + "parts = [\"steps\"]\n",
       at + "2:9: [exercise.01-kinematics]: 'parts': found 'steps', wanted some of maps, step (did you mean "
            "'step'?)"},
      {first + "parts = [\"step\", \"step\"]\n", "'parts': found 'step' twice"},
      {first + "parts = []\n", "'parts': found none"},
      {first + "bonus = 1\n", "'bonus': found 1, wanted true or false"},
      {first + "bonus = true\nminimum_percent = 10\n",
       at + "3:19: [exercise.01-kinematics]: 'minimum_percent': found a minimum of a bonus, wanted a bonus, "
            "which nobody needs, or a minimum"},
      {"[all]\nbonus = true\n" + first, at + "2:9: [all]: 'bonus': wanted it in the table of an exercise"},
      {"[all]\nminimum_percent = 10\n",
       "[all]: 'minimum_percent': found no tables of exercises, wanted [exercise.NAME] for each exercise "
       "that "
       "counts"},
      {"[total]\nbest = 1\n", at + "2:8: [total]: 'best': found no tables of exercises"},
      {"[total]\nbets = 1\n" + first, "unknown key 'bets' in [total]"},
      {"[total]\nbest = 2\n" + first + second + "bonus = true\n",
       "[total]: 'best': found 2, wanted at most 1, as many as there are exercises without bonus"},
      {"[total]\npass_exercises = 1\n" + first,
       "found 1, wanted at most 0, as many as there are exercises with a minimum_percent"},
      {"[all]\nminimum_percent = 10\n[total]\nbest = 1\npass_exercises = 2\n" + first + second,
       "[total]: 'pass_exercises': found 2, wanted at most 1, as only the best 1 count"},
      {"[totl]\nbest = 1\n", "unknown key 'totl' in the course file"}};
  for (const auto& [text, message] : files) EXPECT_THAT(messageFor(text), HasSubstr(message));
}

TEST_F(CourseFileTest, NamesTutorsWithTheirShares) {
  const std::string people = "[[student]]\nid = \"zoe\"\nsection = \"south\"\n",
                    tutor = "[[tutor]]\nname = \"Ann\"\n";
  const Course course =
      read(people + tutor + "adjustments = \"ann.toml\"\n[[tutor]]\nname = \"Ben\"\nsection = \"south\"\n");
  ASSERT_EQ(course.tutors.size(), 2u);
  EXPECT_EQ(course.tutors[0].adjustments, folder_.path() / "ann.toml");
  EXPECT_EQ(course.tutors[1].section, "south");
  EXPECT_THAT(course.files, ElementsAre(folder_.path() / "ann.toml"));
  EXPECT_THAT(
      messageFor(people + tutor + "section = \"sout\"\n"),
      HasSubstr(file() + ":6:11: no section 'sout': wanted a section of the roster (did you mean 'south'?)"));
  EXPECT_THAT(messageFor(tutor + tutor), HasSubstr(":4:8: a second [[tutor]] of the name 'Ann': wanted one"));
  const std::string south = "section = \"south\"\n";
  EXPECT_THAT(messageFor(people + tutor + south + "[[tutor]]\nname = \"Ben\"\n" + south),
              HasSubstr("a second [[tutor]] of the section 'south': wanted one"));
  EXPECT_THAT(messageFor("[[tutor]]\nnam = \"x\"\n"), HasSubstr("'name'"));
}

TEST_F(CourseFileTest, ReadsExtensionsFromATable) {
  const std::string course =
      "extensions = \"extensions.csv\"\n[[student]]\nid = \"zoe\"\ngroup = "
      "\"pair\"\n[exercise.01-kinematics]\n"
      "deadline = 2026-11-20T23:59:00Z\n[exercise.02-control]\ndeadline = 2026-12-04T23:59:00Z\n"
      "[exercise.02-control.extensions]\nzoe = 2026-12-05T00:00:00Z\n";
  const fs::path table = folder_.path() / "extensions.csv";
  const auto deadline = [&](const char* exercise) {
    return instantText(*studentDeadline(read(course).policy.at(exercise), "zoe"));
  };
  writeTextFile(table, "student,exercise,deadline\npair,01,2026-11-27T23:59:00+01:00\n");
  EXPECT_EQ(deadline("01-kinematics"), "2026-11-27T22:59:00Z");
  EXPECT_EQ(deadline("02-control"), "2026-12-05T00:00:00Z");
  writeTextFile(table, "student;deadline\nzoe;2026-12-09T00:00:00Z\nzoe;2026-12-06T00:00:00Z\n");
  EXPECT_EQ(deadline("01-kinematics"), "2026-12-09T00:00:00Z") << "for all exercises, and the latest";
  EXPECT_EQ(deadline("02-control"), "2026-12-09T00:00:00Z");
  EXPECT_EQ(readLatePolicy(file(), {"01-kinematics", "02-control"}).at("02-control").extensions.at("zoe"),
            1796774400);
  const std::string place = table.string();
  for (const auto& [text, message] :
       {std::pair<std::string, std::string>{
            "student,deadline\nzoo,2026-11-27T23:59:00Z\n",
            place + ":2: an extension for 'zoo': found nobody of this name on the roster, wanted the id of "
                    "a student, or a group (did you mean 'zoe'?)"},
        {"student,deadline\nzoe,tomorrow\n",
         place + ":2: not an extension: found 'tomorrow', wanted a time with its zone"},
        {"student,deadline\n,2026-11-27T23:59:00Z\n", ":2: not an extension: found no student"},
        {"student,exercise,deadline\nzoe,02-contrl,2026-11-27T23:59:00Z\n", "(did you mean '02-control'?)"},
        {"student,dedline\nzoe,2026-11-27T23:59:00Z\n", "(did you mean 'deadline'?)"},
        {"student\nzoe\n", "wanted a column 'deadline'"}}) {
    writeTextFile(table, text);
    EXPECT_THAT(messageFor(course), HasSubstr(message));
  }
  fs::remove(table);
  EXPECT_THAT(messageFor(course), HasSubstr(file() + ":1:14: no such table of extensions: found"));
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
  EXPECT_THAT(
      messageFor(zoe + "[exercise.02-control.extensions]\nzoo = 2026-11-20T23:59:00Z\n"),
      HasSubstr(at + "4:7: an extension for 'zoo': found nobody of this name on the roster, wanted the id "
                     "of a student, or a group (did you mean 'zoe'?)"));
  EXPECT_THAT(messageFor("[exercise.02-control]\nweight = 0\n"), HasSubstr("a number above 0"));
  EXPECT_THAT(messageFor("[exercise.02-control]\nweight = 0.001\n"),
              HasSubstr("'weight': wanted at least 0.01"));
  EXPECT_THAT(messageFor("[all]\nweight = 2\n"),
              HasSubstr(at + "2:10: [all]: 'weight': wanted it in the table of an exercise"));
  EXPECT_THAT(messageFor("students = \"none.csv\"\n"),
              HasSubstr(at + "1:12: no such table of students: found"));
  EXPECT_REX_ERROR((readCourse("none.toml", {})), "none.toml: no such file: wanted a course file");
}

// A fault of one row stops that row, not the class.
TEST_F(CourseFileTest, StopsNoRowButTheOneThatIsWrong) {
  const std::string at = file() + ":", zoe = "[[student]]\nid = \"zoe\"\n";
  const std::pair<std::string, std::string> rows[] = {
      {"name = \"Zoe\"\n", at + "3:1: [[student]]: no 'id'"},
      {"id = \"a/b\"\n", at + "4:6: a student: 'id': found a slash"},
      {"id = \"a\u200Cb\"\n", "a student: 'id': found a slash, a control character, an invisible one"},
      {"id = \"\u0639\u0644\u06CC\u200C\u0631\u0636\u0627\"\n", "a student: 'id': found a slash"},
      {"id = \"a\"\nmail = \"x\"\n", "unknown key 'mail' in [[student]]"},
      {"id = \"a\"\nname = \"\"\n", "a string that is not empty"},
      {"id = \"a\"\nname = \"Zoe\\nBcc: x\"\n",
       at + "4:6: a student: 'name': found a line break or an invisible character, wanted one line of text"},
      {"id = \"a\"\nname = \"\u202Eeoz\"\n", "a student: 'name': found a line break or an invisible"},
      {"id = \"Zoe\"\n",
       at + "4:6: a second student with the id 'Zoe': wanted one; the first is at " + at + "2:6"},
      {"id = \"ZO\u00C4\"\nemail = \"a@b\"\n[[student]]\nid = \"zoa\u0308\"\n",
       "a second student with the id 'zoa\u0308'"},
      {"id = \"b\"\nemail = \"a@b\"\n[[student]]\nid = \"a\"\nemail = \"A@b\"\n",
       at + "7:6: a second student with the e-mail 'A@b'"},
      {"id = \"a\"\ngroup = \"zoe\"\n",
       at +
           "4:6: the group 'zoe' is also the id of a student: wanted another "
           "name for the group; the student is at " +
           at + "2:6"}};
  for (const auto& [row, message] : rows) {
    const Course course = read(zoe + "[[student]]\n" + row);
    ASSERT_EQ(course.faults.size(), 1u) << row;
    EXPECT_THAT(course.faults[0].why, HasSubstr(message));
    EXPECT_NE(course.student("zoe"), nullptr);
  }
  const Course alone = read("[[student]]\nid = \"a/b\"\n");
  EXPECT_TRUE(alone.hasRoster() && alone.students.empty()) << "nobody else is graded for somebody's fault";
  EXPECT_EQ(read(zoe + "[[student]]\nid = \"a\"\nmail = \"x\"\n[exercise.02-control.extensions]\na = "
                       "2026-11-20T23:59:00Z\n")
                .faults.size(),
            1u)
      << "and an extension waits for the row";
  EXPECT_FALSE(readCourse(file(), exercises(), RosterUse::kLeave).hasRoster());
}

TEST_F(CourseFileTest, KeepsInNamesWhatTheirScriptNeeds) {
  const std::string ali = "\u0639\u0644\u06CC\u200C\u0631\u0636\u0627";
  writeTextFile(folder_.path() / "students.csv",
                "id,name\nali,\u200F" + ali + "\u200E\nzoe,Zo\u00ADe \uFEFF\n");
  const Course course = read("students = \"students.csv\"\n");
  EXPECT_THAT(course.faults, ::testing::IsEmpty());
  EXPECT_EQ(course.student("ali")->name, ali);
  EXPECT_EQ(course.student("zoe")->name, "Zoe");
  const std::string at = (folder_.path() / "students.csv").string();
  EXPECT_THAT(course.notes,
              ElementsAre(at + ":2: left out of the name of 'ali', where nobody sees it: U+200E, U+200F",
                          at + ":3: left out of the name of 'zoe', where nobody sees it: U+00AD, U+FEFF"));
}

TEST_F(CourseFileTest, NamesTheLineOfABrokenTable) {
  const std::string table = (folder_.path() / "students.csv").string(),
                    course = "students = \"students.csv\"\n";
  writeTextFile(table, "name,group\nZoe,A\n");
  EXPECT_THAT(
      messageFor(course),
      HasSubstr(table + ":1: not a table of students: found the columns name, group, wanted a column 'id'"));
  writeTextFile(table, "id,group\nzoe\nadam,\n,A\nADAM,B\n");
  const Course read = this->read(course);
  ASSERT_EQ(read.faults.size(), 3u);
  EXPECT_THAT(read.faults[0].why, HasSubstr(table + ":2: not a table of students: found 1 fields, wanted 2"));
  EXPECT_EQ(read.faults[0].student.id, "zoe");
  EXPECT_THAT(read.faults[1].why, HasSubstr(table + ":4: a student: 'id': found none"));
  EXPECT_THAT(read.faults[2].why, HasSubstr(table + ":5: a second student with the id 'ADAM'"));
  EXPECT_THAT(read.ids(), ElementsAre("adam"));
}

}  // namespace rex::classroom::course_file_test
