#include "classroom/platform_grades.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::platform_grades_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kEx = "01-kinematics";

class PlatformGradesTest : public ::testing::Test {
 protected:
  PlatformGradesTest() {
    run_.out = folder_.path() / "results";
    source_.points = {{kEx, 10}};
    source_.course.students = {
        {.id = "adam", .name = "Adam =1+2", .email = "adam@uni.example", .number = "4711"},
        {.id = "bob", .name = "Müller, Bob", .section = "A"}};
    saveSample(run_.out, sampleTask("adam"), sampleResult(3, 4, 0));
    run_.tasks = {sampleTask("adam")};
  }
  Gradebook book() const { return makeGradebook(readClassRun(run_.tasks, run_.out), source_); }
  Worksheet worksheet(const std::string& text, bool scale = false) const {
    writeTextFile(file(), text);
    return moodleGrades(file(), book(), kEx, source_.imported, scale);
  }
  std::string file() const { return (folder_.path() / "worksheet.csv").string(); }

  TemporaryFolder folder_;
  ClassRun run_;  // without what is stored: tests change it
  GradebookSource source_;
};

TEST_F(PlatformGradesTest, WritesTheColumnsOfGradescopeAndCanvas) {
  EXPECT_EQ(gradescopeGrades(book()).csv,
            "Name,SID,Email,01-kinematics,Total Score,Max Points\n"
            "Adam =1+2,4711,adam@uni.example,7,7,10\n\"Müller, Bob\",bob,,,0,10\n");
  EXPECT_EQ(canvasGrades(book()).csv,
            "Student,ID,SIS User ID,SIS Login ID,Section,01-kinematics\n"
            "    Points Possible,,,,,10\n"
            "Adam =1+2,,4711,adam,,7\n\"Müller, Bob\",,bob,bob,A,\n");
  EXPECT_THAT(canvasGrades(book()).notes, IsEmpty());
  run_.tasks[0].seed = 3;  // another seed: the result is stale
  EXPECT_THAT(gradescopeGrades(book()).notes,
              ElementsAre("adam 01-kinematics: no grade yet (the result is for other inputs)"));
}

TEST_F(PlatformGradesTest, FollowThePartsAndTheBonusOfTheCourse) {
  grading::GradeResult result = sampleResult(3, 4, 0);
  result.checks[1].part = "turns";
  saveSample(run_.out, run_.tasks[0], result);
  source_.course.exercises[kEx] = {.parts = {"turns"}};
  source_.points[kEx] = 4;
  EXPECT_THAT(canvasGrades(book()).csv, HasSubstr("Points Possible,,,,,4\nAdam =1+2,,4711,adam,,4\n"));
  const std::string head = "Identifier,Email address,Grade,Maximum Grade\nA 1,adam@uni.example,,";
  EXPECT_THAT(worksheet(head + "4.00\n").csv, HasSubstr(",4,4.00\n"));
  EXPECT_THAT(messageOf([&] { worksheet(head + "10.00\n"); }),
              HasSubstr("found 10.00, wanted 4, the points of the exercise, or --scale"));
  source_.course.exercises[kEx].isBonus = true;
  EXPECT_THAT(canvasGrades(book()).csv, HasSubstr("Points Possible,,,,,0\nAdam =1+2,,4711,adam,,4\n"))
      << "as Canvas adds points on top";
  EXPECT_THAT(gradescopeGrades(book()).csv, HasSubstr("adam@uni.example,4,4,0\n"));
  EXPECT_THAT(canvasGrades(book()).notes, IsEmpty());
}

TEST_F(PlatformGradesTest, TellWhoHasMoreThanTheMaximumBeforeTheUpload) {
  source_.adjustments.adjustments = {{.students = {"adam"},
                                      .exercise = kEx,
                                      .add = 350,
                                      .reason = "a bonus",
                                      .author = "T.",
                                      .where = {"a.toml", 1, 1}}};
  const std::string text =
      "adam 01-kinematics: 10.5 points, though the maximum is 10: the platform may refuse or cut them";
  EXPECT_THAT(gradescopeGrades(book()).notes, ElementsAre(text));
  EXPECT_THAT(canvasGrades(book()).notes, ElementsAre(text));
  const Worksheet sheet =
      worksheet("Identifier,Email address,Grade,Maximum Grade\nA 1,adam@uni.example,,10.00\n");
  EXPECT_THAT(sheet.notes, ElementsAre(file() + ":2: " + text));
  EXPECT_THAT(sheet.csv, HasSubstr(",10.5,"));
}

// What Moodle compares when it reads the worksheet must come back as it was.
TEST_F(PlatformGradesTest, CompletesTheWorksheetOfMoodleAndKeepsItsOtherCells) {
  const std::string head =
      "\xef\xbb\xbfIdentifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Last modified "
      "(grade)\"\r\n";
  const Worksheet sheet = worksheet(head +
                                    "\"Participant 501\",Adam,ADAM@uni.example,\"=x, "
                                    "\"\"y\"\"\",,10.00,\"Friday, 20 November 2026, 11:59 PM\"\r\n"
                                    "\"Participant 502\",\"Müller, Bob\",,,3,10.00,-\r\n\"Participant "
                                    "503\",Eve,eve@uni.example,,5,10.00,-\r\n");
  EXPECT_EQ(sheet.csv,
            "\xef\xbb\xbfIdentifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Last "
            "modified (grade)\"\r\n"
            "\"Participant 501\",Adam,ADAM@uni.example,\"=x, \"\"y\"\"\",7,10.00,\"Friday, 20 November 2026, "
            "11:59 PM\"\r\n"
            "\"Participant 502\",\"Müller, Bob\",,,3,10.00,-\r\n\"Participant "
            "503\",Eve,eve@uni.example,,5,10.00,-\r\n");
  EXPECT_THAT(sheet.notes, ElementsAre(file() + ":4: 'Eve' is nobody here; the grade stays as it is"));
  ASSERT_EQ(sheet.rows.size(), 3u);
  EXPECT_EQ(sheet.rows[0].student, "adam");
  EXPECT_EQ(moodleFolder(sheet.rows[1]), "Müller, Bob_502_assignsubmission_file_");
}

TEST_F(PlatformGradesTest, KnowsStudentsByTheIdentifierOfTheImport) {
  source_.imported.students = {{.student = "adam"}};
  source_.imported.students[0].exercises[kEx] = {.platform = "moodle", .identifier = "Teilnehmer/in 501"};
  const Worksheet sheet = worksheet("ID,Bewertung\nTeilnehmer/in 501,\n");
  EXPECT_EQ(sheet.csv, "ID,Bewertung\n\"Teilnehmer/in 501\",7\n");
  EXPECT_THAT(sheet.notes, IsEmpty());
  const std::vector<WorksheetRow> rows = moodleStudents(book(), kEx, source_.imported);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].number, "501");
  EXPECT_THAT(worksheet("Identifier,Grade\nParticipant 9,\n").notes,
              ElementsAre(HasSubstr("'' is nobody here"), "'adam' has a grade and no row in " + file()));
}

TEST_F(PlatformGradesTest, ScalesOnlyOnRequest) {
  const std::string text =
      "Identifier,Email address,Grade,Maximum Grade\nParticipant 1,adam@uni.example,,\"100,00\"\n";
  EXPECT_REX_ERROR((void)worksheet(text),
                   "worksheet.csv:2: the maximum grade of 01-kinematics in Moodle: found 100,00, "
                   "wanted 10, the points of the exercise, or --scale");
  EXPECT_THAT(worksheet(text, true).csv, HasSubstr("adam@uni.example,70,"));
  EXPECT_EQ(worksheet("ID;E-Mail;Bewertung\n1;adam@uni.example;\n").csv,
            "ID;E-Mail;Bewertung\n1;adam@uni.example;7\n")
      << "with its separators";
  EXPECT_REX_ERROR(
      (void)worksheet("ID,E-Mail,Grade\n1,adam@uni.example,\n", true),
      "worksheet.csv:2: the maximum grade of 01-kinematics in Moodle: found none, wanted a number, to "
      "scale the points to it");
}

TEST_F(PlatformGradesTest, RefusesWhatIsNoWorksheet) {
  EXPECT_REX_ERROR((void)worksheet("a,b\n"),
                   "worksheet.csv:1: not a grading worksheet of Moodle: found the columns a, b, "
                   "wanted a column 'Identifier' or 'ID'");
  EXPECT_REX_ERROR((void)worksheet("Identifier,Grade\nx\n"),
                   ":2: not a grading worksheet of Moodle: found 1 fields, wanted 2");
  EXPECT_REX_ERROR(
      (void)worksheet("Identifier,Grade,Email address\nA 1,,adam@uni.example\nA 2,,adam@uni.example\n"),
      ":3: a second row for 'adam': wanted one; the first is at " + file() + ":2");
}

TEST(MoodleFolder, LeavesNoNameThatMoodleTakesApart) {
  EXPECT_EQ(moodleFolder({"", "../_a/b\\c_9_assignsubmission_file_", "7"}),
            "a b c 9 assignsubmission file _7_assignsubmission_file_");
  EXPECT_EQ(moodleFolder({"", "", "7"}), "Student_7_assignsubmission_file_");
  std::string longest;
  for (int k = 0; k < 190; ++k) longest += "\u0436";
  EXPECT_LE(moodleFolder({"", longest, "1234567"}).size(), 255u);
}

}  // namespace rex::classroom::platform_grades_test
