#include "cli/instructor/class_figure.h"

#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::cli::class_figure_test {

using ::testing::ElementsAre;

grading::StudentResult resultOf(const std::string& exercise, int score) {
  grading::StudentResult one{.student = "s", .exercise = exercise, .result = {}};
  one.result.outcome = grading::Outcome::kFail;
  one.result.score = score;
  one.result.maxScore = 4;
  return one;
}

TEST(ClassFigure, ShowsEveryStudentAndTheMedians) {
  const Figure figure = pointsFigure({resultOf("01-a", 4), resultOf("01-a", 4), resultOf("01-a", 1),
                                      resultOf("05-b", 2), resultOf("05-b", 3), resultOf("extra", 0)});
  ASSERT_EQ(figure.series.size(), 2u);
  EXPECT_THAT(figure.series[0].y, ElementsAre(100, 100, 25, 50, 75, 0));
  EXPECT_THAT(figure.series[1].x, ElementsAre(1, 5, 6)) << "without a number: after all others";
  EXPECT_THAT(figure.series[1].y, ElementsAre(100, 62.5, 0));
  EXPECT_NO_THROW(static_cast<void>(figure.xRange.value()));
}

TEST(ClassFigure, LaysNoTwoPointsOnEachOther) {
  std::vector<grading::StudentResult> results;
  for (int k = 0; k < 200; ++k) results.push_back(resultOf("03-a", k % 3));
  const Series students = pointsFigure(results).series[0];
  std::set<std::pair<double, double>> places;
  for (std::size_t k = 0; k < 200; ++k) {
    places.insert({students.x[k], students.y[k]});
    EXPECT_LT(std::abs(students.x[k] - 3), 0.5);
  }
  EXPECT_EQ(places.size(), 200u);
}

TEST(ClassFigure, NeedsPoints) {
  std::vector<grading::StudentResult> results = {resultOf("01-a", 0)};
  results[0].result.outcome = grading::Outcome::kGraderError;
  EXPECT_REX_ERROR(pointsFigure(results), "no points to draw: found only faults of the grader");
}

TEST(ClassFigure, ShowsWhichPartIsHard) {
  grading::ExerciseStatistics first{.exercise = "03-a", .graded = 2}, second{.exercise = "05-b", .graded = 2};
  first.parts = {{.id = "easy", .maxPoints = 4, .meanPoints = 4},
                 {.id = "hard", .maxPoints = 4, .meanPoints = 1}};
  second.parts = {{.id = "half", .maxPoints = 2, .meanPoints = 1}};
  grading::ExerciseStatistics zeroth{.exercise = "00-c", .graded = 2};
  zeroth.parts = {{.id = "all", .maxPoints = 2, .meanPoints = 2}};
  EXPECT_EQ(partsFigure({zeroth, first}).notes[0].y, 0);
  const Figure figure = partsFigure({first, second});
  ASSERT_EQ(figure.notes.size(), 3u);
  EXPECT_EQ(figure.notes[1].text, "hard 25 %");
  EXPECT_EQ(figure.notes[1].y, 3);
  EXPECT_EQ(figure.notes[2].text, "half 50 %");
  EXPECT_EQ(figure.notes[2].y, 5);
  const auto blueOf = [&](std::size_t k) { return figure.regions[k].color->b; };
  EXPECT_GT(blueOf(0), blueOf(2));
  EXPECT_GT(blueOf(2), blueOf(1));
  EXPECT_REX_ERROR(partsFigure({{.exercise = "01-a"}}), "no points to draw: found only faults of the grader");
}

}  // namespace rex::cli::class_figure_test
