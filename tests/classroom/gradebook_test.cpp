#include "classroom/gradebook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "classroom/class_statistics.h"
#include "classroom/submission_folder.h"
#include "grading/hidden_seed.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::gradebook_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kTime = 1'700'000'000, kDay = 86400;
const std::string kEx = "01-kinematics";

class GradebookTest : public ::testing::Test {
 protected:
  GradebookTest() {
    run_.out = folder_.path();
    source_.points = {{kEx, 10}, {"02-control", 20}};
    source_.course.students = {{.id = "adam", .name = "Adam A.", .group = "pair"},
                               {.id = "bob"},
                               {.id = "carl"},
                               {.id = "zoe", .group = "pair"}};
  }
  void handIn(const std::string& student, int points, std::int64_t submitted = kTime,
              const std::string& exercise = kEx) {
    const Task task = sampleTask(student, exercise, submitted);
    saveSample(run_.out, task,
               sampleResult(std::min(points, 3), std::clamp(points - 3, 0, 4), std::max(points - 7, 0)));
    run_.tasks.push_back(task);
  }
  Adjustment adjustment(const std::string& student, const std::string& check) const {
    return {.students = {student},
            .exercise = kEx,
            .check = check,
            .reason = "seen",
            .author = "Tutor",
            .date = "2026-12-01",
            .where = {"a.toml", 3, 1}};
  }
  Gradebook made() const { return makeGradebook(readClassRun(run_.tasks, run_.out), source_); }
  GradeRow row(const std::string& student) const { return *made().row(student, kEx); }

  TemporaryFolder folder_;
  ClassRun run_;  // without what is stored: tests change it
  GradebookSource source_;
};

TEST_F(GradebookTest, GivesEveryoneOnTheRosterARow) {
  handIn("bob", 7), handIn("Dora", 10);
  source_.rejected = {{"carl", "", "no exercise is called '01-kinematic'"}, {"emil", "", "a link"}};
  const Gradebook book = made();
  ASSERT_EQ(book.rows.size(), 4u);
  EXPECT_EQ(book.row("adam", kEx)->status, RowStatus::kMissing);
  EXPECT_FALSE(book.row("adam", kEx)->final.has_value());
  EXPECT_EQ(book.row("adam", kEx)->possible, 1000) << "of the exercise";
  EXPECT_EQ(book.row("bob", kEx)->status, RowStatus::kGraded);
  EXPECT_EQ(book.row("bob", kEx)->final, 700);
  EXPECT_EQ(book.row("carl", kEx)->status, RowStatus::kRejected);
  EXPECT_EQ(book.row("carl", kEx)->remark, "no exercise is called '01-kinematic'");
  ASSERT_EQ(book.strangers.size(), 1u);
  EXPECT_EQ(book.strangers[0].student.id, "Dora");
  EXPECT_EQ(book.strangers[0].final, 1000);
  EXPECT_THAT(book.notes, Contains("'emil' is not on the roster: a link"));
  EXPECT_EQ(gradesCsv({*book.row("bob", kEx)}),
            "student,name,email,group,exercise,status,points,possible,outcome,adjusted,late,penalty,final,"
            "submitted,"
            "time_from,handed_in_as,remark\n"
            "bob,,,,01-kinematics,graded,7,10,fail,,0,0,7,2023-11-14T22:13:20Z,table,bob,\n");
  EXPECT_THAT(gradesCsv({*book.row("adam", kEx)}),
              HasSubstr("\nadam,Adam A.,,pair,01-kinematics,missing,,10,,,,,,,,,\n"));
}

TEST_F(GradebookTest, CountsWhatCouldNotBeReadAsNotTaken) {
  handIn("bob", 0);
  source_.rejected = {{"bob", kEx, "found a symbolic link"}};
  EXPECT_EQ(row("bob").status, RowStatus::kRejected);
  EXPECT_EQ(row("bob").remark, "found a symbolic link");
  EXPECT_EQ(row("bob").final, 0);
}

TEST_F(GradebookTest, GivesNoGradeWithoutAValidResult) {
  handIn("bob", 7), handIn("carl", 7), handIn("zoe", 7);
  run_.tasks[0].seed = 3;
  saveSample(run_.out, run_.tasks[1], [] {
    grading::GradeResult result = sampleResult(0, 0, 0);
    result.outcome = grading::Outcome::kGraderError;
    return result;
  }());
  std::filesystem::remove(run_.out / "zoe" / kEx / "results.json");
  const Gradebook book = made();
  for (const char* student : {"adam", "bob", "carl", "zoe"}) {
    EXPECT_EQ(book.row(student, kEx)->status, RowStatus::kToRepeat) << student;
    EXPECT_FALSE(book.row(student, kEx)->final.has_value());
  }
  EXPECT_EQ(row("bob").remark, "the result is for other inputs");
  EXPECT_EQ(row("carl").remark, "the grader failed");
  EXPECT_EQ(row("zoe").remark, "there is no result yet");
  EXPECT_FALSE(book.totals[1].total.has_value()) << "never a zero";
}

// The last submission of a pair counts for both, whoever handed it in.
TEST_F(GradebookTest, CountsTheLastSubmissionOfAGroupForEachMember) {
  handIn("adam", 7), handIn("zoe", 5, kTime + 60);
  Gradebook book = made();
  EXPECT_EQ(book.row("adam", kEx)->final, 500);
  EXPECT_EQ(book.row("adam", kEx)->handedInAs, "zoe");
  EXPECT_EQ(book.row("adam", kEx)->remark, "handed in by zoe");
  EXPECT_EQ(book.row("zoe", kEx)->final, 500);
  EXPECT_THAT(book.notes,
              ElementsAre(kEx + " was handed in 2 times by one student or group: 'adam' "
                                "(2023-11-14T22:13:20Z), 'zoe' (2023-11-14T22:14:20Z); the last one counts"));
  EXPECT_TRUE(book.strangers.empty());
}

TEST_F(GradebookTest, NamesAllWhoHandedInForReportsOfAPair) {
  handIn("adam", 7), handIn("zoe", 10, kTime + 60), handIn("bob", 4);
  const Gradebook book = made();
  const auto earlier = taskJudgement(book, run_.tasks, 0), later = taskJudgement(book, run_.tasks, 1),
             alone = taskJudgement(book, run_.tasks, 2);
  ASSERT_TRUE(earlier && later && alone);
  EXPECT_EQ(later->student, "Adam A., zoe");
  EXPECT_THAT(later->changes, ElementsAre());
  EXPECT_EQ(earlier->student, later->student);
  EXPECT_EQ(earlier->final, later->final) << "what counts for both";
  EXPECT_THAT(earlier->changes, ElementsAre("The points are those of what zoe handed in later."));
  EXPECT_EQ(alone->student, "bob");
}

TEST_F(GradebookTest, CountsPeopleForStatistics) {
  handIn("adam", 7), handIn("zoe", 10, kTime + 60), handIn("bob", 5), handIn("Dora", 1);
  Adjustment turn = adjustment("bob", "turn"), bonus = adjustment("bob", "");
  turn.points = 400, bonus.add = 50;
  source_.adjustments.adjustments = {turn, bonus};
  const ClassResults people = resultsByPerson(readClassResults(run_.out), made());
  std::vector<std::string> found;
  for (const StudentResult& one : people.results)
    found.push_back(one.student + " " + std::to_string(one.result.score));
  EXPECT_THAT(found, ElementsAre("adam 10", "bob 7", "zoe 10")) << "not adam's 7, nor Dora";
  const ExerciseStatistics all = exerciseStatistics(people.results).at(0);
  EXPECT_EQ(all.graded, 3);
  EXPECT_EQ(all.checks.at(0).id, "far");
  EXPECT_EQ(all.checks.at(0).failed, 1) << "bob, whose other checks are full now";
  EXPECT_EQ(all.checks.at(1).failed, 0);
}

TEST_F(GradebookTest, TakesTheFolderOfAGroup) {
  handIn("PAIR", 9);
  EXPECT_EQ(row("adam").final, 900);
  EXPECT_EQ(row("zoe").final, 900);
  EXPECT_EQ(row("bob").status, RowStatus::kMissing);
}

TEST_F(GradebookTest, KnowsPeopleByWhatPlatformsSayOfThem) {
  source_.course.students = {{.id = "adam", .number = "4711"},
                             {.id = "bob", .email = "bob@uni.example"},
                             {.id = "carl", .name = "Carl C."},
                             {.id = "dora"},
                             {.id = "emil"}};
  const auto person = [&](const std::string& folder, ImportedStudent known, const std::string& by) {
    known.student = folder;
    known.exercises[kEx] = {.status = SubmissionStatus::kHandedIn, .handedInBy = by};
    source_.imported.students.push_back(known);
  };
  person("501", {.id = "4711", .name = "Adam A."}, "501");
  person("502", {.email = "BOB@uni.example"}, "502");
  person("503", {.name = "Carl C."}, "503");
  person("504", {.githubUsername = "dora"}, "503");
  source_.imported.students.push_back({.student = "505", .githubUsername = "emil"});
  source_.imported.students.back().exercises[kEx] = {.status = SubmissionStatus::kRejected,
                                                     .why = "two files"};
  handIn("501", 1), handIn("502", 2), handIn("503", 3);
  EXPECT_EQ(row("adam").final, 100);
  EXPECT_EQ(row("adam").student.name, "Adam A.");
  EXPECT_EQ(row("bob").final, 200);
  EXPECT_EQ(row("carl").final, 300);
  EXPECT_EQ(row("dora").final, 300) << "a group of the platform";
  EXPECT_EQ(row("emil").status, RowStatus::kRejected);
  EXPECT_EQ(row("emil").remark, "two files");
}

TEST(SubmissionOwnersTest, BelieveAddressesRatherThanNamesOfFolders) {
  const Course course{.students = {{.id = "adam", .name = "J\u00FCrgen Gro\u00DF"},
                                   {.id = "bob", .email = "bob@uni.example"},
                                   {.id = "\u00C4nne"}}};
  EXPECT_EQ(courseStudent({.student = "adam", .email = "Bob@uni.example"}, course), "bob");
  EXPECT_EQ(courseStudent({.student = "ADAM", .email = "x@uni.example"}, course), "adam");
  EXPECT_EQ(courseStudent({.student = "7", .name = "Ju\u0308rgen GROSS"}, course), "adam") << "decomposed";
  EXPECT_EQ(courseStudent({.student = "a\u0308nne"}, course), "\u00C4nne");
  EXPECT_EQ(courseStudent({.student = "7"}, course), "");
}

TEST_F(GradebookTest, HasARowForEachSubmissionWithoutARoster) {
  source_.course.students.clear();
  source_.imported.students = {{.student = "bob", .name = "Bob B."}, {.student = "eve"}};
  handIn("bob", 7);
  const Gradebook book = made();
  EXPECT_FALSE(book.hasRoster);
  EXPECT_EQ(book.row("bob", kEx)->student.name, "Bob B.");
  EXPECT_EQ(book.row("eve", kEx)->status, RowStatus::kMissing);
}

// Of a row that the roster has and that cannot be taken: the others keep theirs, and the table says why.
TEST_F(GradebookTest, StopsForAFaultyRowNobodyButThatStudent) {
  source_.course.faults = {
      {{.id = "dora", .email = "d@x", .group = "pair"}, "s.csv:7: a student: 'name': found x"},
      {{.id = "emil"}, "s.csv:8: a student: 'name': found y"},
      {{.id = "fay", .email = "f@x"}, "s.csv:9: a student: 'name': found z"}};
  source_.imported.students = {{.student = "f@x", .email = "f@x"}};
  handIn("dora", 7), handIn("bob", 5), handIn("f@x", 3);
  source_.adjustments.adjustments = {adjustment("emil", "")};
  const Gradebook book = made();
  EXPECT_EQ(book.rows.size(), 4u);
  EXPECT_EQ(book.row("adam", kEx)->final, 700) << "a partner of dora";
  EXPECT_EQ(book.row("bob", kEx)->final, 500);
  ASSERT_EQ(book.strangers.size(), 3u);
  EXPECT_EQ(book.strangers[0].remark, "not on the roster: s.csv:9: a student: 'name': found z");
  EXPECT_EQ(book.strangers[0].final, 300);
  EXPECT_EQ(book.strangers[1].remark, "s.csv:7: a student: 'name': found x");
  EXPECT_EQ(book.strangers[2].student.id, "emil");
  EXPECT_EQ(book.strangers[2].status, RowStatus::kRejected);
  EXPECT_THAT(book.notes, Contains("a.toml:3:1: waits until the row of 'emil' is taken from the roster"));
  source_.course.students.clear();
  EXPECT_TRUE(made().rows.empty()) << "the roster has people, though none that can be taken";
}

TEST(StudentCalled, IsFoundByAnyKey) {
  const Course course{.students = {{.id = "adam", .name = "Jürgen Groß", .email = "a@x", .number = "4711"},
                                   {.id = "bob", .name = "Li Wei"},
                                   {.id = "eve", .name = "li wei"}}};
  const ImportTable imported{.students = {{.student = "b@x", .email = "b@x", .githubUsername = "octo"},
                                          {.student = "participant-7", .id = "adam"}}};
  const auto called = [&](const char* text) {
    return studentCalled(text, course, imported, {"team", "zoe"});
  };
  for (const char* text : {"adam", "ADAM", "4711", "A@x", "ju\u0308rgen GROSS", "participant-7"})
    EXPECT_EQ(called(text), "adam") << text;
  EXPECT_EQ(called("Team"), "team");
  EXPECT_EQ(called("octo"), "") << "a person who is not of the course";
  EXPECT_EQ(called("nobody"), "");
  EXPECT_REX_ERROR((void)called("Li Wei"),
                   "several students are called 'Li Wei': wanted one of the ids bob, eve");
}

TEST_F(GradebookTest, AddsWhatCountsByItsWeight) {
  source_.course.exercises = {{kEx, {.weight = 250}}, {"02-control", {}}, {"03-later", {}}};
  handIn("bob", 7), handIn("bob", 4, kTime, "02-control"), handIn("bob", 9, kTime, "04-other");
  const Gradebook book = made();
  EXPECT_THAT(book.exercises, ElementsAre(kEx, "02-control"));
  EXPECT_EQ(book.totals[1].total, 2150) << "2.5 times 7, and 4";
  EXPECT_EQ(book.totals[1].possible, 3500);
  EXPECT_EQ(book.totals[0].total, 0) << "nothing handed in";
  EXPECT_EQ(book.totals[0].possible, 4500);
  EXPECT_THAT(book.notes, ElementsAre("04-other is not an exercise of the course: it does not count",
                                      "03-later: nobody has handed it in, so it does not count yet"));
  source_.imported.students = {{.student = "bob"}};
  source_.imported.students[0].exercises["03-later"].status = SubmissionStatus::kHandedIn;
  EXPECT_THAT(made().notes, Contains("03-later: it was imported, but not graded, so it does not count yet"));
  source_.imported.students.clear();
  EXPECT_THAT(totalsCsv(book), HasSubstr("student,name,email,group,01-kinematics,02-control,total,possible\n"
                                         "adam,Adam A.,,pair,,,0,45\nbob,,,,7,4,21.5,35\n"));
  source_.only = kEx;
  EXPECT_EQ(made().rows.size(), 4u);
}

// Of the sample's checks, "hand" of 3 points and "far" of 3 are in the part that counts.
TEST_F(GradebookTest, CountsOnlyThePartsOfTheCourse) {
  handIn("bob", 8);  // 3 of 3, 4 of 4, 1 of 3
  grading::GradeResult result = sampleResult(3, 4, 1);
  result.checks[1].part = "turns";
  saveSample(run_.out, run_.tasks[0], result);
  source_.course.exercises[kEx] = {.parts = {"kin"}, .minimum = 8000};
  Adjustment turn = adjustment("bob", "turn");
  turn.points = 0;
  source_.adjustments.adjustments = {turn};
  const Gradebook book = made();
  const GradeRow graded = *book.row("bob", kEx);
  EXPECT_EQ(graded.final, 400);
  EXPECT_EQ(graded.possible, 600);
  EXPECT_THAT(book.notes,
              ElementsAre("a.toml:3:1: the check 'turn' is in part 'turns', which does not count"));
  EXPECT_THAT(gradesCsv({graded}), HasSubstr(",graded,4,6,fail,,0,0,4,"));
  EXPECT_THAT(reports::judgementSentences(rowJudgement(graded).value()),
              ElementsAre("Only these parts count: kin.", "The minimum of 80 % is not reached.",
                          "Final grade: 4 of 6 points."));
  EXPECT_THAT(explain(graded), AllOf(Contains("Checks: 4 of 6 points (fail)"),
                                     Contains("  4/4 Turns [turn, does not count]: pass"),
                                     Contains("Only these parts count: kin.")));
  const StudentResult counted = resultsByPerson(readClassResults(run_.out), book).results.at(0);
  EXPECT_EQ(counted.result.score, 4);
  EXPECT_EQ(counted.result.maxScore, 6);
  EXPECT_EQ(counted.result.checks.size(), 2u);
}

TEST_F(GradebookTest, AddsABonusToThePointsButNotToThoseThatArePossible) {
  source_.course.exercises = {{kEx, {}}, {"02-control", {.weight = 50, .isBonus = true}}};
  handIn("bob", 9), handIn("bob", 10, kTime, "02-control");
  const Gradebook book = made();
  EXPECT_EQ(book.totals[1].total, 1400) << "9, and half of 10";
  EXPECT_EQ(book.totals[1].possible, 1000);
  EXPECT_THAT(explain(*book.row("bob", "02-control")),
              Contains("The exercise is a bonus: its points come on top."));
}

TEST_F(GradebookTest, LeavesOutTheExercisesWithTheSmallestShares) {
  source_.course.exercises = {{kEx, {}}, {"02-control", {}}, {"03-later", {.weight = 300}}, {"04-more", {}}};
  source_.course.total.best = 2;
  source_.points["03-later"] = source_.points["04-more"] = 10;
  handIn("bob", 7), handIn("bob", 4, kTime, "02-control"), handIn("bob", 5, kTime, "03-later");
  handIn("bob", 9, kTime, "04-more");
  handIn("carl", 10), handIn("carl", 10, kTime, "03-later");
  const Gradebook book = made();
  EXPECT_THAT(book.totals[1].leftOut, ElementsAre("02-control", "03-later"));
  EXPECT_EQ(book.totals[1].total, 1600);
  EXPECT_EQ(book.totals[1].possible, 2000);
  EXPECT_THAT(book.totals[2].leftOut, ElementsAre("02-control", "04-more")) << "what is missing";
  EXPECT_EQ(book.totals[2].total, 4000);
  EXPECT_EQ(book.totals[2].possible, 4000);
  EXPECT_THAT(totalsCsv(book), HasSubstr("\ncarl,,,,10,,10,,40,40,\"02-control, 04-more\"\n"));
  EXPECT_THAT(totalsCsv(book), HasSubstr("total,possible,left_out\n"));
}

TEST_F(GradebookTest, SaysWhoPassesAndWhyNot) {
  source_.course.exercises = {{kEx, {.minimum = 5000}}, {"02-control", {.minimum = 3000}}};
  source_.course.total = {.passPercent = 6000};
  handIn("bob", 7), handIn("bob", 5, kTime, "02-control");
  handIn("carl", 4), handIn("carl", 10, kTime, "02-control");
  handIn("zoe", 5), handIn("zoe", 6, kTime, "02-control");
  Gradebook book = made();
  EXPECT_EQ(totalsCsv(book),
            "student,name,email,group,01-kinematics,02-control,total,possible,passes,why_not\n"
            "adam,Adam A.,,pair,5,6,11,20,no,11 of 20 points are less than 60 %\n"
            "bob,,,,7,5,12,20,yes,\n"
            "carl,,,,4,10,14,20,no,below the minimum: 01-kinematics\n"
            "zoe,,,pair,5,6,11,20,no,11 of 20 points are less than 60 %\n");
  source_.course.total = {.passExercises = 1};
  book = made();
  EXPECT_TRUE(book.totals[2].passes.value()) << "one exercise is enough";
  source_.course.total = {.passExercises = 2};
  EXPECT_THAT(made().totals[2].why, ElementsAre("the minimum is reached in 1 of 2 exercises"));
  run_.tasks[0].seed = 3;
  EXPECT_FALSE(made().totals[1].passes.has_value()) << "a grading must be repeated";
}

TEST_F(GradebookTest, AppliesAdjustmentsOfChecksBeforeAndOfTheTotalAfterLateness) {
  handIn("bob", 5, kTime + kDay);
  source_.course.policy[kEx] = {.deadline = kTime, .perDay = 1000};
  Adjustment hand = adjustment("bob", "turn"), bonus = adjustment("bob", "");
  hand.points = 400, bonus.add = 50;
  source_.adjustments.adjustments = {bonus, hand};
  const GradeRow graded = row("bob");
  EXPECT_EQ(graded.status, RowStatus::kLate);
  EXPECT_EQ(graded.result->score, 5) << "the result itself never changes";
  EXPECT_EQ(graded.points, 700);
  EXPECT_EQ(graded.late.penalty, 70);
  EXPECT_EQ(graded.final, 680);
  EXPECT_THAT(gradesCsv({graded}), HasSubstr("late,5,10,fail,2.5,1,0.7,6.8,"));
  const reports::Judgement judgement = rowJudgement(graded).value();
  EXPECT_THAT(
      reports::judgementSentences(judgement),
      ElementsAre("Turns [turn]: 4 instead of 2 points: seen (Tutor, 2026-12-01)",
                  "Final points: 6.8 instead of 6.3 points: seen (Tutor, 2026-12-01)",
                  "Handed in at 2023-11-15T22:13:20Z, deadline 2023-11-14T22:13:20Z. 1 day late: 0.7 of 7 "
                  "points are taken away.",
                  "Final grade: 6.8 of 10 points."));
  EXPECT_THAT(
      explain(graded),
      ElementsAre("bob (bob), 01-kinematics: late",
                  "Handed in at 2023-11-15T22:13:20Z (time from table) as 'bob'",
                  "Deadline 2023-11-14T22:13:20Z", "Checks: 5 of 10 points (fail)",
                  "  3/3 Position of the hand [hand]: pass", "  2/4 Turns [turn]: fail",
                  "  0/3 SECRET title [far, hidden]: fail",
                  "Adjusted, a.toml:3:1: Turns [turn]: 4 instead of 2 points: seen (Tutor, 2026-12-01)",
                  "1 day late: 0.7 of 7 points are taken away.",
                  "Adjusted, a.toml:3:1: Final points: 6.8 instead of 6.3 points: seen (Tutor, 2026-12-01)",
                  "Final: 6.8 of 10 points"));
}

TEST_F(GradebookTest, TellsStudentsOnlyTheNumberOfAHiddenCheck) {
  handIn("bob", 7);
  Adjustment far = adjustment("bob", "far");
  far.points = 150;
  source_.adjustments.adjustments = {far};
  const std::vector<std::string> sentences = reports::judgementSentences(rowJudgement(row("bob")).value());
  EXPECT_EQ(sentences.at(0), "Hidden check 1: 1.5 instead of 0 points: seen (Tutor, 2026-12-01)");
}

TEST_F(GradebookTest, KeepsAdjustmentsWithinTheirCheckAndFinalPointsAboveZero) {
  handIn("bob", 5);
  Adjustment more = adjustment("bob", "turn"), less = adjustment("bob", "");
  more.add = 900, less.add = -2000;
  source_.adjustments.adjustments = {more};
  EXPECT_EQ(row("bob").final, 700);
  EXPECT_THAT(made().notes, Contains("a.toml:3:1: the check 'turn' of bob stays within 0 and 4 points"));
  source_.adjustments.adjustments = {less};
  EXPECT_EQ(row("bob").final, 0);
}

TEST_F(GradebookTest, AddsUpTheAdjustmentsOfOneCheck) {
  handIn("bob", 4);  // 3 of 3, and 1 of 4
  Adjustment one = adjustment("bob", "turn"), most = one;
  one.add = 100, most.add = 300;
  source_.adjustments.adjustments = {one, one};
  EXPECT_EQ(row("bob").final, 600) << "the second begins where the first ended";
  EXPECT_EQ(row("bob").applied[1].before, 200);
  source_.adjustments.adjustments = {one, one, most};
  EXPECT_EQ(row("bob").final, 700) << "and they stop at the maximum";
}

TEST_F(GradebookTest, RoundsHalvesOfWeightedTotalsUp) {
  source_.course.exercises = {{kEx, {.weight = 33}}};
  for (const auto& [points, add, total] : {std::tuple(5, 0, 165), {5, 5, 167}, {5, 1, 165}, {5, 2, 166}}) {
    run_.tasks.clear();
    handIn("bob", points);
    Adjustment bonus = adjustment("bob", "");
    bonus.add = add;
    source_.adjustments.adjustments = {bonus};
    EXPECT_EQ(made().totals[1].total, total) << "0.33 times " << 100 * points + add;
  }
}

// Why a folder was not taken is old news for an exercise that was.
TEST_F(GradebookTest, SaysNothingOfARejectionBesideAGrade) {
  handIn("bob", 5);
  source_.rejected = {{"bob", "", "no exercise is called '01-kinematic'"}};
  EXPECT_EQ(row("bob").remark, "");
  EXPECT_EQ(row("bob").status, RowStatus::kGraded);
}

TEST_F(GradebookTest, GivesPointsForWhatWasNotHandedIn) {
  handIn("bob", 5);
  Adjustment oral = adjustment("carl", ""), check = adjustment("carl", "hand");
  oral.points = 600, check.add = 100;
  source_.adjustments.adjustments = {oral, check};
  EXPECT_EQ(row("carl").status, RowStatus::kMissing);
  EXPECT_EQ(row("carl").final, 600);
  EXPECT_THAT(made().notes, ElementsAre("a.toml:3:1: 'carl' has no result for 01-kinematics to adjust"));
  run_.tasks[0].seed = 3;  // stale
  oral.students = {"bob"};
  source_.adjustments.adjustments = {oral};
  EXPECT_FALSE(row("bob").final.has_value());
  EXPECT_THAT(made().notes, ElementsAre("a.toml:3:1: 'bob' has no result for 01-kinematics to adjust"));
}

TEST_F(GradebookTest, RefusesAdjustmentsThatDoNotFit) {
  handIn("bob", 5);
  Adjustment one = adjustment("bob", "turns");
  source_.adjustments.adjustments = {one};
  EXPECT_REX_ERROR((void)row("bob"),
                   "a.toml:3:1: 01-kinematics has no check 'turns': wanted the id of a check, or no "
                   "check to change the final points (did you mean 'turn'?)");
  one.check = "turn", one.points = 500;
  source_.adjustments.adjustments = {one};
  EXPECT_REX_ERROR((void)row("bob"),
                   "a.toml:3:1: [[adjustment]] of the check 'turn': found 5 points, wanted at most 4");
  one.exercise = "02-control";
  source_.adjustments.adjustments = {one};
  EXPECT_THAT(made().notes, ElementsAre("a.toml:3:1: nobody has handed in 02-control"));
}

TEST_F(GradebookTest, GivesCommentsToTheFileThatCounts) {
  handIn("zoe", 5);
  const Comment first{
      .students = {"adam", "zoe"}, .exercise = kEx, .line = 1, .text = "nice", .where = {"a.toml", 9, 1}};
  Comment other = first;
  other.students = {"bob"}, other.line = 0;
  source_.adjustments.comments = {first, other};
  EXPECT_EQ(row("adam").comments.size(), 1u);
  EXPECT_THAT(made().notes, ElementsAre("a.toml:9:1: 'bob' handed in no 01-kinematics to comment on"));
  source_.adjustments.comments[0].line = 2;
  EXPECT_REX_ERROR((void)row("adam"),
                   "a.toml:9:1: a comment on line 2 of adam: found a file of 1 lines, wanted one of them");
}

TEST_F(GradebookTest, ShowsTimesInTheZoneOfTheCourseAndTheGrace) {
  handIn("bob", 5, kTime + 590);
  source_.course.policy[kEx] = {.deadline = kTime, .graceSeconds = 900, .perDay = 1000};
  source_.course.timeZone = "Europe/Berlin";
  const GradeRow graded = row("bob");
  EXPECT_EQ(graded.status, RowStatus::kGraded);
  EXPECT_THAT(gradesCsv({graded}), HasSubstr(",2023-11-14T23:23:10+01:00,"));
  EXPECT_THAT(explain(graded), Contains("Handed in at 2023-11-14T23:23:10+01:00 (time from table) as 'bob'"));
  EXPECT_THAT(explain(graded),
              Contains("Deadline 2023-11-14T23:13:20+01:00; 10 minutes after it, within the grace of 15"));
  EXPECT_THAT(reports::judgementSentences(rowJudgement(graded).value()).front(),
              HasSubstr("10 minutes after it, within the grace of 15."));
}

// Somebody unpacked it by hand and put the file where it belongs.
TEST_F(GradebookTest, CountsWhatWasPutRightAfterAnImport) {
  handIn("bob", 5);
  source_.imported.students = {{.student = "bob"}, {.student = "carl"}};
  for (ImportedStudent& one : source_.imported.students)
    one.exercises[kEx] = {.status = SubmissionStatus::kRejected, .why = "an archive in an archive"};
  EXPECT_EQ(row("bob").status, RowStatus::kGraded);
  EXPECT_EQ(row("bob").remark, "");
  EXPECT_EQ(row("carl").status, RowStatus::kRejected);
}

TEST_F(GradebookTest, TellsWhoHasAnExtension) {
  handIn("bob", 5, kTime + kDay);
  source_.course.policy[kEx] = {.deadline = kTime, .extensions = {{"bob", kTime + kDay}}, .perDay = 1000};
  EXPECT_EQ(row("bob").status, RowStatus::kGraded);
  EXPECT_THAT(explain(row("bob")), Contains("Deadline 2023-11-15T22:13:20Z, an extension of this student"));
  EXPECT_THAT(explain(row("carl")), Contains("No grade (of 10 points)"));
}

TEST(RejectedList, KeepsWhatWasNotTaken) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "not_taken.tsv";
  EXPECT_TRUE(readRejected(file).empty());
  writeTextFile(file, rejectedText({{"zoe", kEx, "a\tlink"}, {"adam", "", "x"}}));
  const std::vector<RejectedSubmission> all = readRejected(file);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].why, "a link");
  EXPECT_EQ(all[1].exercise, "");
  writeTextFile(file, "student\texercise\twhy\nzoe\n");
  EXPECT_REX_ERROR((void)readRejected(file),
                   ":2: not a list of what was not taken: wanted student, exercise and reason");
}

}  // namespace rex::classroom::gradebook_test
