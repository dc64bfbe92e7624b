#include "cli/student/records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/student/test_run.h"

namespace rex::cli::records_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Of another file each time.
grading::GradeResult resultWith(double length, double rides) {
  static int files = 0;
  grading::GradeResult result{.snapshotSha256 = std::to_string(++files)};
  result.checks = {
      {.id = "a", .record = grading::Record{.name = "length", .value = length, .unit = "m"}},
      {.id = "b", .record = grading::Record{.name = "rides", .value = rides, .isMoreBetter = true}},
      {.id = "c"}};
  return result;
}

TEST(Records, KeepEachAttemptOnce) {
  Records records;
  for (const auto& [length, rides] : std::vector<std::pair<double, double>>{{3, 7}, {2, 7}, {2, 9}, {2.5, 8}})
    addRecords(records, resultWith(length, rides));
  ASSERT_EQ(records.size(), 2u);
  EXPECT_THAT(records.at("length").values, ElementsAre(3, 2, 2.5));
  EXPECT_THAT(records.at("rides").values, ElementsAre(7, 9, 8));
  EXPECT_EQ(bestOf(records.at("length")), 2);
  EXPECT_EQ(bestOf(records.at("rides")), 9);
}

TEST(Records, TakeOneAttemptOfAFile) {
  Records records;
  grading::GradeResult result = resultWith(3, 7);
  addRecords(records, result);
  result.checks[0].record->value = 2.9;  // a time, measured again
  addRecords(records, result);
  EXPECT_THAT(records.at("length").values, ElementsAre(3));
  result.snapshotSha256 = "other";
  addRecords(records, result);
  EXPECT_THAT(records.at("length").values, ElementsAre(3, 2.9));
  EXPECT_THAT(records.at("rides").values, ElementsAre(7));
}

TEST(Records, ForgetOldAttemptsButNotTheBest) {
  Records records;
  addRecords(records, resultWith(-1, 1e6));
  for (std::size_t k = 0; k < kMostAttempts + 10; ++k)
    addRecords(records, resultWith(static_cast<double>(k), static_cast<double>(k)));
  const Attempts &length = records.at("length"), &rides = records.at("rides");
  EXPECT_EQ(length.values.size(), kMostAttempts);
  EXPECT_EQ(length.values[0], -1);
  EXPECT_EQ(length.values[1], 11);
  EXPECT_EQ(length.values.back(), kMostAttempts + 9);
  EXPECT_EQ(rides.values[0], 1e6);
}

TEST(Records, AreToldWithTheBest) {
  struct Row {
    Attempts attempts;
    std::string text;
  };
  for (const Row& row : std::vector<Row>{
           {{.unit = "m", .values = {1.62345}}, "x: 1.623 m"},
           {{.unit = "m", .values = {1.7, 1.58, 1.62}}, "x: 1.62 m, your best was 1.58 m (3 attempts)"},
           {{.values = {812, 655}}, "x: 655, your best (2 attempts)"},
           {{.isMoreBetter = true, .values = {8, 9, 7}}, "x: 7, your best was 9 (3 attempts)"}})
    EXPECT_EQ(recordText("x", row.attempts), row.text);
}

TEST(Records, AreDrawnOverTheAttempts) {
  const Figure figure = recordFigure("length", {.unit = "m", .values = {3, 2, 2.5}});
  EXPECT_EQ(figure.title, "length");
  EXPECT_EQ(figure.yLabel, "value [m]");
  EXPECT_THAT(figure.series.at(0).x, ElementsAre(1, 2, 3));
  EXPECT_THAT(figure.series.at(0).y, ElementsAre(3, 2, 2.5));
  EXPECT_EQ(figure.horizontalLines.at(0).at, 2);
}

TEST(Records, AndRemarksAreInTheReport) {
  ExerciseInfo exercise;
  exercise.name = "98-demo", exercise.title = "Demo";
  exercise.parts.emplace_back();
  exercise.parts[0].id = "p", exercise.parts[0].title = "Part";
  submission::Submission graded;
  graded.result.outcome = grading::Outcome::kPass;
  graded.result.checks = {{.id = "a",
                           .part = "p",
                           .title = "A search",
                           .status = grading::Outcome::kPass,
                           .remark = "Of 10 rides, 3 last."}};
  ::testing::internal::CaptureStdout();
  printResult(exercise, graded, "out/results.json", "main.cpp", {.records = {"length: 2 m"}});
  const std::string text = ::testing::internal::GetCapturedStdout();
  EXPECT_THAT(text, HasSubstr("A search [a]\n             Of 10 rides, 3 last.\n"));
  EXPECT_THAT(text, HasSubstr("Record: length: 2 m\n"));
}

}  // namespace rex::cli::records_test
