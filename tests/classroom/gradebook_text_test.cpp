#include "classroom/gradebook_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text_file.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::classroom::gradebook_text_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;
const std::string kEx = "01-kinematics";

class ClassFeedbackTest : public ::testing::Test {
 protected:
  ClassFeedbackTest() {
    run_.out = folder_.path() / "results";
    source_.points = {{kEx, 10}};
    for (const char* student : {"adam", "zoe"}) {
      const std::string mark = std::string("PLANTED-") + student;
      source_.course.students.push_back(
          {.id = student, .name = mark + "-name", .email = std::string(student) + "@uni.example"});
      grading::GradeResult result = sampleResult(3, 1, 0);
      result.checks[1].message = mark + "-message <b>";
      result.checks[0].picture = "checks/hand.png", result.checks[1].replay = "checks/turn.html";
      result.checks[2].picture = "checks/far.png";
      const Task task = sampleTask(student);
      saveSample(run_.out, task, result, "int main() {}\n// " + mark + "-line </td>\n");
      for (const char* name : {"hand.png", "turn.html", "far.png"})
        writeTextFile(resultFolder(run_.out, task) / "checks" / name, mark + "-" + name);
      run_.tasks.push_back(task);
      source_.adjustments.comments.push_back(
          {.students = {student}, .exercise = kEx, .line = 2, .text = mark + "-comment", .author = "Tutor"});
    }
  }
  Gradebook book() const { return makeGradebook(readClassRun(run_.tasks, run_.out), source_); }

  TemporaryFolder folder_;
  ClassRun run_;  // without what is stored: tests change it
  GradebookSource source_;
};

TEST_F(ClassFeedbackTest, ShowsEachStudentNothingOfOthersNorOfHiddenChecks) {
  const fs::path out = folder_.path() / "feedback";
  EXPECT_EQ(writeFeedbackFolders(book(), run_.out, out), 2);
  for (const std::string student : {"adam", "zoe"}) {
    const std::string other = student == "adam" ? "zoe" : "adam", mark = "PLANTED-" + student;
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(out / student))
      if (entry.is_regular_file()) all += entry.path().string() + fileText(entry.path());
    EXPECT_THAT(all, Not(HasSubstr(other)));
    EXPECT_THAT(all, Not(HasSubstr("SECRET")));
    EXPECT_THAT(all, Not(HasSubstr("far")));
    for (const char* own :
         {"-name", "-message &#60;b&#62;", "-line &#60;/td&#62;", "-comment (Tutor)", "-turn.html"})
      EXPECT_THAT(all, HasSubstr(mark + own));
  }
  const std::string page = fileText(out / "adam" / kEx / "feedback.html");
  EXPECT_THAT(page, HasSubstr("<tr class=\"passes\"><td>pass</td>"));
  EXPECT_THAT(page, HasSubstr("<h1>01-kinematics: 4 of 10 points</h1>"));
  EXPECT_THAT(page, HasSubstr("<td>fail</td><td>Hidden check 1</td><td>0/3</td><td></td>"));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,UExBTlRFRC1hZGFtLWhhbmQucG5n\""));
  EXPECT_THAT(page, HasSubstr("<a href=\"checks/turn.html\">Replay: Turns</a>"));
  EXPECT_THAT(page, HasSubstr("<tr id=\"line2\">"));
  EXPECT_FALSE(fs::exists(out / "adam" / kEx / "checks/hand.png")) << "it is in the page";
}

TEST_F(ClassFeedbackTest, ShowsPointsOfPeopleInTheRowOfTheirCheckAndInItsPart) {
  grading::GradeResult result = sampleResult(3, 1, 0);
  result.checks[0].part = "pos";
  saveSample(run_.out, run_.tasks[0], result, "a\nb\n");
  source_.adjustments.adjustments = {{.students = {"adam"}, .exercise = kEx, .check = "turn", .add = 150}};
  const auto feedback = rowFeedback(*book().row("adam", kEx), run_.out).value();
  EXPECT_THAT(reports::feedbackPage(feedback, {}),
              AllOf(HasSubstr("<td>2.5/4 instead of 1/4</td>"), HasSubstr("<td>3/3</td>"),
                    HasSubstr("By part: pos 3/3, kin 2.5/7.")));
}

TEST_F(ClassFeedbackTest, NeverTakesFilesFromElsewhere) {
  const Task task = run_.tasks[0];
  for (const char* name : {"../../zoe/01-kinematics/main.cpp", "/etc/hostname", "checks/../main.cpp",
                           "checks/none.png", "main.cpp"}) {
    grading::GradeResult result = sampleResult(3, 1, 0);
    result.checks[0].picture = name;
    saveSample(run_.out, task, result);
    source_.adjustments.comments.clear();
    EXPECT_TRUE(evidenceFiles(*book().row("adam", kEx), run_.out).empty()) << name;
  }
}

TEST_F(ClassFeedbackTest, SaysWhatDoesNotCompileAndGivesNothingForNothing) {
  grading::GradeResult result = sampleResult(0, 0, 0);
  result.outcome = grading::Outcome::kCompileError;
  for (grading::CheckResult& check : result.checks) check.status = {};
  result.compile.diagnostics = {
      {.file = "main.cpp", .line = 2, .severity = "error", .message = "expected '}' <x>"}};
  saveSample(run_.out, run_.tasks[0], result, "a\nb\n");
  run_.tasks.pop_back();
  source_.adjustments = {};
  const auto feedback = rowFeedback(*book().row("adam", kEx), run_.out).value();
  EXPECT_THAT(reports::feedbackPage(feedback, {}),
              HasSubstr("<pre>main.cpp:2: error: expected &#39;}&#39; &#60;x&#62;"));
  EXPECT_FALSE(rowFeedback(*book().row("zoe", kEx), run_.out).has_value());
}

TEST_F(ClassFeedbackTest, RefusesStudentsWhoseNameIsNoFolder) {
  Gradebook all = book();
  all.rows[0].student.id = "../zoe";
  EXPECT_REX_ERROR(writeFeedbackFolders(all, run_.out, folder_.path() / "x"),
                   "no folder for '../zoe': found ");
}

TEST_F(ClassFeedbackTest, ReplacesItsOwnFilesAndNoOthers) {
  const fs::path out = folder_.path() / "feedback", zoe = out / "zoe" / kEx;
  EXPECT_EQ(writeFeedbackFolders(book(), run_.out, out), 2);
  fs::remove(run_.out / "zoe" / kEx / "results.json");
  EXPECT_EQ(writeFeedbackFolders(book(), run_.out, out), 1);
  EXPECT_FALSE(fs::exists(zoe)) << "of a result that is no more";
  writeTextFile(zoe / "main.cpp", "mine");
  EXPECT_REX_ERROR(
      writeFeedbackFolders(book(), run_.out, out),
      "not replaced by feedback: found 'main.cpp', which no export wrote, wanted another folder");
  EXPECT_EQ(fileText(zoe / "main.cpp"), "mine");
}

TEST_F(ClassFeedbackTest, GivesAllGradesToPrograms) {
  const auto json = nlohmann::json::parse(gradesJson(book(), source_.course));
  EXPECT_EQ(json.at("schema"), "rex-grades/1");
  EXPECT_EQ(json.at("students").size(), 2u);
  EXPECT_EQ(json.at("students")[0].at("grades")[0].at("final"), 4);
  EXPECT_EQ(json.at("students")[0].at("grades")[0].at("comments")[0].at("line"), 2);
  EXPECT_EQ(json.at("exercises")[0].at("weight"), 1);
}

}  // namespace rex::classroom::gradebook_text_test
