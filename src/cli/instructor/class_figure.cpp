#include "cli/instructor/class_figure.h"

#include <algorithm>
#include <cstdlib>
#include <map>

#include <fmt/format.h>

#include "base/error.h"

namespace rex::cli {
namespace {

using grading::StudentResult;

double percentOf(const grading::GradeResult& result) {
  return result.maxScore > 0 ? 100.0 * result.score / result.maxScore : 0;
}

// The position of each exercise on the axis.
std::map<std::string, int> placesOf(const std::vector<StudentResult>& results) {
  std::map<std::string, int> places;
  int last = 0;
  for (const StudentResult& one : results) {
    const int number = std::atoi(one.exercise.c_str());
    places[one.exercise] = number;
    last = std::max(last, number);
  }
  for (auto& [exercise, place] : places)
    if (place == 0) place = ++last;
  return places;
}

// Offsets around 0: 0, 1, -1, 2, ... steps, which are narrower if there are many points.
double offsetOf(int k, int count) {
  constexpr double kStep = 0.06, kWidest = 0.4;
  const double step = std::min(kStep, 2 * kWidest / std::max(1, count));
  return (k % 2 == 1 ? 1 : -1) * ((k + 1) / 2) * step;
}

}  // namespace

Figure pointsFigure(const std::vector<StudentResult>& results) {
  const std::map<std::string, int> places = placesOf(results);
  std::map<int, std::vector<double>> points;
  for (const StudentResult& one : results)
    if (one.result.outcome != grading::Outcome::kGraderError)
      points[places.at(one.exercise)].push_back(percentOf(one.result));
  if (points.empty()) throw Error({.what = "no points to draw", .found = "only faults of the grader"});
  Series students{.label = "a student", .style = SeriesStyle::kPoints, .marker = Marker::kDot, .size = 2};
  Series medians{.label = "median", .style = SeriesStyle::kPoints, .marker = Marker::kPlus, .size = 3};
  for (const auto& [place, values] : points) {
    std::map<double, int> drawn;
    for (const double value : values) {
      const auto same = static_cast<int>(std::count(values.begin(), values.end(), value));
      students.x.push_back(place + offsetOf(drawn[value]++, same));
      students.y.push_back(value);
    }
    medians.x.push_back(place);
    medians.y.push_back(grading::medianOf(values));
  }
  return {.title = "Points of the class",
          .xLabel = "number of the exercise",
          .yLabel = "points [% of the maximum]",
          .xRange = AxisRange{points.begin()->first - 0.5, points.rbegin()->first + 0.5},
          .yRange = AxisRange{-5, 105},
          .legend = Legend::kOutside,
          .series = {std::move(students), std::move(medians)}};
}

}  // namespace rex::cli
