// The term of 14 weeks of share/doc/teaching.md, share/grading/term.toml, played by thirty people.
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "classroom/class_statistics.h"
#include "classroom/gradebook.h"
#include "classroom/platform_grades.h"
#include "support/class_results.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::classroom::term_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A check per part. `share` says how much of each part somebody reached.
template <class Share>
grading::GradeResult resultOf(const submission::ExerciseInfo& exercise, const Share& share) {
  grading::GradeResult result{.files = {{"main.cpp", ""}}, .exerciseId = exercise.name};
  for (const submission::ExercisePart& part : exercise.parts) {
    const int points = static_cast<int>(part.points * share(part.id));
    const bool isFull = points == part.points;
    result.checks.push_back({.id = part.id + "-check",
                             .part = part.id,
                             .title = part.title,
                             .status = isFull ? grading::Outcome::kPass : grading::Outcome::kFail,
                             .points = points,
                             .maxPoints = part.points});
    result.score += points, result.maxScore += part.points;
  }
  result.outcome = result.score == result.maxScore ? grading::Outcome::kPass : grading::Outcome::kFail;
  return result;
}

class TermTest : public ::testing::Test {
 protected:
  TermTest() {
    run_.out = folder_.path();
    source_.course = readCourse(sourcePath("share/grading/term.toml"), exercises_);
    for (const submission::ExerciseInfo& exercise : exercises_)
      for (const submission::ExercisePart& part : exercise.parts)
        if (source_.course.exercise(exercise.name).counts(part.id))
          source_.points[exercise.name] += part.points;
    for (int k = 1; k <= 30; ++k) source_.course.students.push_back({.id = idOf(k)});
  }
  static std::string idOf(int k) { return fmt::format("s{:02}", k); }

  /// Days after the deadline; negative: before.
  template <class Share>
  void handIn(int k, const std::string& exercise, const Share& share, double days = -1) {
    const std::int64_t deadline = source_.course.policy.at(exercise).deadline.value();
    const Task task = sampleTask(idOf(k), exercise, deadline + static_cast<std::int64_t>(days * 86400));
    saveSample(run_.out, task, resultOf(submission::findExercise(exercises_, exercise), share));
    run_.tasks.push_back(task);
  }

  /// Five people with totals by hand, and others who do something of everything.
  void playTheTerm() {
    const auto all = [](const std::string&) { return 1.0; };
    for (const auto& [name, worth] : source_.course.exercises) {
      const auto counted = [&, parts = worth](const std::string& part) {
        return parts.counts(part) ? 1.0 : 0.0;
      };
      handIn(1, name, all);
      if (!worth.isBonus) handIn(2, name, counted);
      if (!worth.isBonus && name != "05-car" && name != "15-graphSLAM") handIn(3, name, all);
      if (!worth.isBonus && name < "07") handIn(4, name, all);
      if (!worth.isBonus) handIn(5, name, all, 0.5);
      int turn = 0;
      for (int k = 6; k <= 30; ++k)
        if ((k + static_cast<int>(name.size())) % 5 != 0)
          handIn(k, name, [&](const std::string&) { return (k + ++turn) % 3 * 0.5; });
    }
  }
  const StudentTotal& total(const Gradebook& book, int k) const {
    return book.totals.at(static_cast<std::size_t>(k) - 1);
  }

  TemporaryFolder folder_;
  std::vector<submission::ExerciseInfo> exercises_ = submission::listExercises(sourcePath("exercises"));
  ClassRun run_;
  GradebookSource source_;
};

// 14 exercises without bonus have 250 points in the parts that count: ten of 20, two of 13, two of 12. Who
// has equal shares of all leaves out two of 20 points, so that 210 are possible.
TEST_F(TermTest, AddsUpAsByHand) {
  playTheTerm();
  const Gradebook book = makeGradebook(readClassRun(run_.tasks, run_.out), source_);
  EXPECT_EQ(book.totals.size(), 30u);
  EXPECT_THAT(book.notes, IsEmpty());
  EXPECT_EQ(total(book, 1).total, 35000) << "210, and seven exercises of 20 on top";
  EXPECT_EQ(total(book, 1).possible, 21000);
  EXPECT_THAT(total(book, 1).leftOut, ElementsAre("08-mdp", "09-racer"));
  EXPECT_EQ(total(book, 2).total, 21000) << "the voluntary parts are worth nothing";
  EXPECT_EQ(total(book, 3).total, 21700) << "250 without 05 of 20 points and 15 of 13 points";
  EXPECT_EQ(total(book, 3).possible, 21700);
  EXPECT_THAT(total(book, 3).leftOut, ElementsAre("05-car", "15-graphSLAM"));
  EXPECT_EQ(total(book, 4).total, 15200) << "00, 00b and 01 to 06";
  EXPECT_EQ(total(book, 4).possible, 21000) << "of six that are missing, two of 20 points are left out";
  EXPECT_THAT(total(book, 4).why, ElementsAre("the minimum is reached in 8 of 10 exercises"));
  EXPECT_EQ(total(book, 5).total, 18900) << "a day late everywhere: 90 % of 210";
  for (const int k : {1, 2, 3, 5}) EXPECT_TRUE(total(book, k).passes.value()) << k;
}

TEST_F(TermTest, GivesPlatformsAndStatisticsThePartsThatCount) {
  playTheTerm();
  const Gradebook book = makeGradebook(readClassRun(run_.tasks, run_.out), source_);
  EXPECT_THAT(
      canvasGrades(book).csv,
      HasSubstr("\n    Points Possible,,,,,20,12,20,20,20,20,20,20,20,0,20,20,12,13,0,0,0,13,0,0,0\n"));
  EXPECT_THAT(gradescopeGrades(book).notes, IsEmpty());
  const auto statistics = exerciseStatistics(resultsByPerson(readClassResults(run_.out), book).results);
  for (const ExerciseStatistics& one : statistics) {
    if (one.exercise != "10-planning2d") continue;
    EXPECT_EQ(one.maxPoints, 12);
    EXPECT_EQ(one.parts.size(), 3u);
  }
}

// Each exercise of the plan is in the file, in the week of its row. Week 7 hands out nothing.
TEST_F(TermTest, IsThePlanOfTheDocument) {
  const std::string document = fileText(sourcePath("share/doc/teaching.md"));
  std::map<std::int64_t, int> weeks;
  for (const auto& [name, worth] : source_.course.exercises)
    weeks.emplace(source_.course.policy.at(name).opening.value(), 0);
  constexpr int kWithout = 7;
  int week = 0;
  for (auto& [opening, number] : weeks) number = week += week + 1 == kWithout ? 2 : 1;
  EXPECT_EQ(week, 14);
  const auto rowOf = [&](int number) {
    const std::size_t row = document.find(fmt::format("\n| {} |", number));
    return document.substr(row + 1, document.find('\n', row + 1) - row);
  };
  EXPECT_THAT(rowOf(kWithout), HasSubstr("nothing: a week to breathe"));
  for (const auto& [name, worth] : source_.course.exercises) {
    const int number = weeks.at(source_.course.policy.at(name).opening.value());
    EXPECT_THAT(rowOf(number), HasSubstr("`" + name + "`"));
  }
  EXPECT_EQ(source_.course.exercises.size(), exercises_.size());
}

}  // namespace rex::classroom::term_test
