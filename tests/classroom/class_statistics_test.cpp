#include "classroom/class_statistics.h"

#include <cmath>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "classroom/import_table.h"
#include "grading/results.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::class_statistics_test {

using grading::Outcome;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

// Student k of n has k of n - 1 points.
std::vector<StudentResult> staircase(int n) {
  std::vector<StudentResult> results;
  for (int k = 0; k < n; ++k) {
    StudentResult one{.student = "s" + std::to_string(k), .exercise = "01-a", .result = {}};
    one.result.outcome = k == n - 1 ? Outcome::kPass : Outcome::kFail;
    one.result.score = k;
    one.result.maxScore = n - 1;
    one.result.usage.wallSeconds = (k * 7) % n;  // a permutation unless 7 divides n
    results.push_back(one);
  }
  return results;
}

grading::CheckResult check(const std::string& id, std::optional<Outcome> status,
                           const std::string& message = "") {
  return {.id = id, .title = "Title of " + id, .status = status, .message = message, .property = "length"};
}

TEST(ClassStatistics, AreThoseOfAStaircase) {
  for (const int n : {2, 5, 9, 20}) {
    const ExerciseStatistics all = exerciseStatistics(staircase(n)).front();
    EXPECT_EQ(all.graded, n);
    EXPECT_EQ(all.full, 1);
    EXPECT_EQ(all.maxPoints, n - 1);
    EXPECT_DOUBLE_EQ(all.meanPoints, (n - 1) / 2.0) << "sum of 0 to n - 1, over n";
    EXPECT_DOUBLE_EQ(all.medianPoints, (n - 1) / 2.0);
    EXPECT_DOUBLE_EQ(all.medianSeconds, (n - 1) / 2.0);
    EXPECT_DOUBLE_EQ(all.longestSeconds, n - 1);
    EXPECT_EQ((std::stoi(all.slowest.substr(1)) * 7) % n, n - 1);
  }
  // Points 0 to 8 of 8.
  EXPECT_THAT(exerciseStatistics(staircase(9)).front().distribution, ElementsAre(1, 2, 2, 2, 1, 1));
}

TEST(ClassStatistics, TakeTheMiddleOfSkewedPoints) {
  std::vector<StudentResult> results = staircase(4);
  const int points[] = {3, 0, 0, 0};
  for (std::size_t k = 0; k < 4; ++k) results[k].result.score = points[k];
  const ExerciseStatistics all = exerciseStatistics(results).front();
  EXPECT_DOUBLE_EQ(all.meanPoints, 0.75);
  EXPECT_DOUBLE_EQ(all.medianPoints, 0);
  EXPECT_THAT(all.distribution, ElementsAre(1, 0, 0, 0, 0, 3));
  EXPECT_DOUBLE_EQ(all.medianSeconds, 1.5);
  results[0].result.outcome = Outcome::kCompileError;  // the one of 0 s
  EXPECT_DOUBLE_EQ(exerciseStatistics(results).front().medianSeconds, 2);
  EXPECT_EQ(medianValue({}), 0);
  EXPECT_EQ(medianValue({5, 1, 3}), 3);
}

TEST(ClassStatistics, CountFaultsOfTheGraderApart) {
  std::vector<StudentResult> results = staircase(3);
  results[0].result.outcome = Outcome::kGraderError;
  results[1].result.exerciseVersion = "another";
  const ExerciseStatistics all = exerciseStatistics(results).front();
  EXPECT_EQ(all.graded, 2);
  EXPECT_EQ(all.graderFailed, 1);
  EXPECT_EQ(all.versions, 2);
  EXPECT_DOUBLE_EQ(all.meanPoints, 1.5);
  results.resize(1);
  const ExerciseStatistics none = exerciseStatistics(results).front();
  EXPECT_EQ(none.graded, 0);
  EXPECT_EQ(none.meanPoints, 0);
  EXPECT_TRUE(none.checks.empty());
}

TEST(ClassStatistics, PutTheMostFailedChecksFirst) {
  std::vector<StudentResult> results = staircase(4);
  results[0].result.checks = {check("a", Outcome::kPass), check("b", Outcome::kTimeLimit),
                              check("c", Outcome::kFail)};
  results[1].result.checks = {check("a", Outcome::kPass), check("b", Outcome::kFail),
                              check("c", Outcome::kPass)};
  results[2].result.checks = {check("a", Outcome::kPass), check("b", Outcome::kFail),
                              check("c", Outcome::kPass)};
  results[3].result.outcome = Outcome::kCompileError;
  results[3].result.checks = {check("a", {}), check("b", {}), check("c", {})};
  const std::vector<CheckStatistics> checks = exerciseStatistics(results).front().checks;
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].id, "b");
  EXPECT_EQ(checks[0].failed, 4);
  EXPECT_THAT(checks[0].classes, ElementsAre(Pair("compile", 1), Pair("timeout", 1), Pair("wrong", 2)));
  EXPECT_EQ(checks[1].id, "c");
  EXPECT_EQ(checks[1].failed, 2);
  EXPECT_EQ(checks[2].id, "a");
  EXPECT_EQ(checks[2].failed, 1);
}

TEST(ClassStatistics, NameTheClassOfEachFailure) {
  const grading::GradeResult whole;
  const std::pair<Outcome, const char*> classes[] = {{Outcome::kCompileError, "compile"},
                                                     {Outcome::kRuntimeError, "crash"},
                                                     {Outcome::kTimeLimit, "timeout"},
                                                     {Outcome::kMemoryLimit, "memory"},
                                                     {Outcome::kOutputLimit, "output"},
                                                     {Outcome::kProtocolError, "protocol"},
                                                     {Outcome::kSecurityEvent, "security"},
                                                     {Outcome::kGraderError, "not run"},
                                                     {Outcome::kFail, "wrong"}};
  for (const auto& [outcome, name] : classes) EXPECT_EQ(failureClass(check("a", outcome), whole), name);
  EXPECT_EQ(failureClass(check("a", {}), whole), "not run");
  EXPECT_EQ(failureClass(check("a", Outcome::kFail, "0 of 2 cases hold; case 1: length: not finite: got nan"),
                         whole),
            "non-finite");
  EXPECT_EQ(failureClass(check("a", Outcome::kFail, "length: wrong shape: got 3 x 1, wanted 2 x 1"), whole),
            "shape");
}

TEST(ClassResults, AreReadAndForeignFilesTold) {
  const TemporaryFolder folder;
  const auto save = [&](const std::string& student, const std::string& exercise, const std::string& id) {
    grading::GradeResult result;
    result.exerciseId = id;
    result.outcome = Outcome::kFail;
    writeTextFile(folder.path() / student / exercise / "results.json", grading::toJson(result));
  };
  save("zoe", "01-a", "01-a"), save("adam", "01-a", "01-a"), save("adam", "02-b", "02-b");
  save("eve", "01-a", "02-b");
  writeTextFile(folder.path() / "bob/01-a/results.json", "{}");
  writeTextFile(folder.path() / "carl/01-a/results.json", "{\"schema\": \"grade-result/1\", \"sco");
  writeTextFile(folder.path() / "dora/01-a/main.cpp", "int main() {}");
  writeTextFile(folder.path() / "grades.csv", "student\n");
  const ClassResults read = readClassResults(folder.path());
  std::vector<std::string> names;
  for (const StudentResult& one : read.results) names.push_back(one.student + " " + one.exercise);
  EXPECT_THAT(names, ElementsAre("adam 01-a", "zoe 01-a", "adam 02-b"));
  EXPECT_THAT(
      read.complaints,
      ElementsAre(HasSubstr("bob/01-a/results.json: result file: field 'schema'"),
                  HasSubstr("carl/01-a/results.json: result file: not JSON: wanted grade-result/1"),
                  HasSubstr("dora/01-a/results.json: not counted: found no result, wanted this file"),
                  HasSubstr("eve/01-a/results.json: not counted: found a result of '02-b', wanted one "
                            "of '01-a'")));
  EXPECT_REX_ERROR(readClassResults(folder.path() / "none"), "none: cannot read this folder: found ");
}

TEST(ClassStatistics, NameTheFirstFullScoreAndCountAttempts) {
  std::vector<StudentResult> results = staircase(3);
  for (StudentResult& one : results) one.result.score = one.result.maxScore;
  EXPECT_FALSE(exerciseStatistics(results).front().firstFull) << "at an unknown time";
  EXPECT_EQ(exerciseStatistics(results).front().attempts.known, 0);
  results[0].submitted = 300, results[1].submitted = 200, results[1].timeFrom = "platform";
  results[2].submitted = 100, results[2].result.score = 0;
  results[0].attempts = 4, results[0].attemptsFrom = "platform";
  results[2].attempts = 1, results[2].attemptsFrom = "imports";
  const ExerciseStatistics all = exerciseStatistics(results).front();
  EXPECT_EQ(all.firstFull.value().student, "s1");
  EXPECT_EQ(all.firstFull->submitted, 200);
  EXPECT_EQ(all.firstFull->timeFrom, "platform");
  EXPECT_EQ(all.attempts.known, 2);
  EXPECT_EQ(all.attempts.atLeast, 1);
  EXPECT_DOUBLE_EQ(all.attempts.median, 2.5);
  EXPECT_EQ(all.attempts.most, 4);
  EXPECT_EQ(all.attempts.mostBy, "s0");
}

// Three checks of one point each: those of part p are passed by the good half, the odd one by the others.
std::vector<StudentResult> halves() {
  std::vector<StudentResult> results;
  for (int k = 0; k < 8; ++k) {
    const bool good = k < 4;
    StudentResult one{.student = "s" + std::to_string(k), .exercise = "01-a", .result = {}};
    const auto point = [&](const std::string& id, const std::string& part, bool has) {
      grading::CheckResult result = check(id, has ? Outcome::kPass : Outcome::kFail);
      if (!has) result.message = "length: got 2, wanted 1 (seed 1). Is it a " + id + "?";
      result.part = part;
      result.points = has ? 1 : 0;
      result.maxPoints = 1;
      one.result.score += result.points;
      one.result.checks.push_back(result);
    };
    point("a", "p", good), point("b", "p", good), point("odd", "q", !good), point("all", "q", true);
    one.result.outcome = Outcome::kFail;
    one.result.maxScore = 4;
    results.push_back(one);
  }
  return results;
}

TEST(ClassStatistics, GiveMediansOfTheWorkThatWasHandedIn) {
  std::vector<StudentResult> results = halves();
  const ExerciseStatistics none = exerciseStatistics(results).front();
  EXPECT_EQ(none.work.known, 0);
  EXPECT_EQ(none.parts.front().timed, 0);
  results[0].work = submission::WorkTime{.seconds = 3600, .parts = {{"p", 1800}}};
  results[3].work = submission::WorkTime{.seconds = 7200, .parts = {{"p", 7200}, {"q", 5400}}};
  results[5].work = submission::WorkTime{.seconds = 14400};
  const ExerciseStatistics all = exerciseStatistics(results).front();
  EXPECT_EQ(all.work.known, 3);
  EXPECT_DOUBLE_EQ(all.work.medianHours, 2);
  EXPECT_EQ(all.parts.at(0).timed, 2);
  EXPECT_DOUBLE_EQ(all.parts.at(0).medianHours, 1.25);
  EXPECT_EQ(all.parts.at(1).timed, 1);
  EXPECT_DOUBLE_EQ(all.parts.at(1).medianHours, 1.5);
}

TEST(ClassResults, KnowTimesAndAttemptsAndRefuseWhatWasEdited) {
  const TemporaryFolder folder;
  const Task adam = sampleTask("adam"), zoe = sampleTask("zoe");
  saveSample(folder.path(), adam, sampleResult(3, 4, 3));
  grading::GradeResult edited = sampleResult(3, 0, 0);
  edited.score = 10;
  saveSample(folder.path(), zoe, edited);
  writeTextFile(folder.path() / "tasks.tsv", toManifest({adam, zoe}));
  const ImportTable imported{{{.student = "adam",
                               .exercises = {{"01-kinematics",
                                              {.platform = "gradescope",
                                               .status = SubmissionStatus::kHandedIn,
                                               .handedInBy = "adam",
                                               .attempts = 3,
                                               .attemptsFrom = "platform",
                                               .work = submission::WorkTime{.seconds = 60}}}}}}};
  writeTextFile(folder.path() / kImportTable, importTableText(imported));
  const ClassResults read = readClassResults(folder.path());
  ASSERT_EQ(read.results.size(), 1u);
  EXPECT_EQ(read.results[0].submitted, adam.submitted);
  EXPECT_EQ(read.results[0].timeFrom, "table");
  EXPECT_EQ(read.results[0].attempts, 3);
  EXPECT_EQ(read.results[0].attemptsFrom, "platform");
  EXPECT_EQ(read.results[0].work.value().seconds, 60);
  EXPECT_THAT(read.complaints,
              ElementsAre(HasSubstr("zoe/01-kinematics/results.json: a result that does not add up")));
  writeTextFile(folder.path() / "tasks.tsv", "x");
  EXPECT_THAT(readClassResults(folder.path()).complaints,
              ::testing::Contains(HasSubstr("not a list of tasks")));
}

TEST(ClassStatistics, SayHowEachCheckSeparatesStudents) {
  const ExerciseStatistics all = exerciseStatistics(halves()).front();
  std::map<std::string, CheckStatistics> checks;
  for (const CheckStatistics& one : all.checks) checks[one.id] = one;
  // (1, 2) for the good half and (0, 2) for the others: b and all, or odd and all.
  EXPECT_FALSE(checks["a"].discrimination) << "the rest is the same for all";
  EXPECT_FALSE(checks["all"].discrimination) << "everybody passes it";
  EXPECT_NEAR(checks["odd"].discrimination.value(), -1, 1e-12);
  EXPECT_THAT(checks["a"].questions, ElementsAre(Pair("Is it a a?", 4)));
  EXPECT_EQ(checks["odd"].part, "q");
}

// The formula for a coefficient of two binary numbers, (n11 n00 - n10 n01) / root of the product of the sums.
TEST(ClassStatistics, AgreeWithTheCorrelationOfFourFields) {
  std::vector<StudentResult> results;
  const int fields[2][2] = {{5, 2}, {1, 4}};
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int k = 0; k < fields[x][y]; ++k) {
        StudentResult one{.student = "s", .exercise = "01-a", .result = {}};
        grading::CheckResult tried = check("a", x == 1 ? Outcome::kPass : Outcome::kFail);
        tried.points = x;
        one.result.checks = {tried};
        one.result.score = x + y;
        one.result.maxScore = 2;
        one.result.outcome = Outcome::kFail;
        results.push_back(one);
      }
  EXPECT_NEAR(exerciseStatistics(results).front().checks.front().discrimination.value(),
              (5 * 4 - 2 * 1) / std::sqrt(7.0 * 5 * 6 * 6), 1e-12);
}

TEST(ClassStatistics, AddUpThePointsOfParts) {
  const std::vector<PartStatistics> parts = exerciseStatistics(halves()).front().parts;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].id, "p");
  EXPECT_EQ(parts[0].maxPoints, 2);
  EXPECT_DOUBLE_EQ(parts[0].meanPoints, 1);
  EXPECT_EQ(parts[0].full, 4);
  EXPECT_DOUBLE_EQ(parts[1].meanPoints, 1.5);
}

TEST(ClassStatistics, FindTheQuestionOfAMessage) {
  EXPECT_EQ(askedQuestion("a: got 1.5, wanted 2 (seed 7). Is it 1? It is not."), "Is it 1? It is not.");
  EXPECT_EQ(askedQuestion("a: got 1, wanted 2 (seed 7)"), "");
  EXPECT_EQ(askedQuestion("a: got 1, wanted 2 (seed 7). A remark."), "");
}

}  // namespace rex::classroom::class_statistics_test
