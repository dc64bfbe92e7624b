#include "cli/instructor/class_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace rex::cli {
namespace {

using grading::StudentResult;

double percentOf(const grading::GradeResult& result) {
  return result.maxScore > 0 ? 100.0 * result.score / result.maxScore : 0;
}

// The position of each exercise on the axis: its number, or the next after the largest.
std::map<std::string, int> placesOf(const std::set<std::string>& exercises) {
  const auto numberOf = [](std::string_view name) { return takeNumber<int>(name); };
  std::map<std::string, int> places;
  int last = 0;
  for (const std::string& one : exercises)
    if (const auto number = numberOf(one)) last = std::max(last, places[one] = *number);
  for (const std::string& one : exercises)
    if (!numberOf(one)) places[one] = ++last;
  return places;
}

// Offsets around 0: 0, 1, -1, 2, ... steps, which are narrower if there are many points.
double offsetOf(int k, int count) {
  constexpr double kStep = 0.06, kWidest = 0.4;
  const double step = std::min(kStep, 2 * kWidest / std::max(1, count));
  return (k % 2 == 1 ? 1 : -1) * ((k + 1) / 2) * step;
}

// A field of one part; `share` is the part of the points that the class got.
Region fieldOf(double x, double y, double share) {
  constexpr double kHalfWidth = 0.48, kHalfHeight = 0.42;
  // A tenth less must be seen.
  const auto shade = static_cast<float>(std::sqrt(1 - std::clamp(share, 0.0, 1.0)));
  return {.x = {x - kHalfWidth, x + kHalfWidth, x + kHalfWidth, x - kHalfWidth},
          .y = {y - kHalfHeight, y - kHalfHeight, y + kHalfHeight, y + kHalfHeight},
          .color = Color{1 - 0.2F * shade, 1 - 0.8F * shade, 1 - shade}};
}

}  // namespace

Figure pointsFigure(const std::vector<StudentResult>& results) {
  std::set<std::string> exercises;
  for (const StudentResult& one : results) exercises.insert(one.exercise);
  const std::map<std::string, int> places = placesOf(exercises);
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

Figure partsFigure(const std::vector<grading::ExerciseStatistics>& all) {
  std::set<std::string> exercises;
  for (const grading::ExerciseStatistics& one : all)
    if (one.graded > 0 && !one.parts.empty()) exercises.insert(one.exercise);
  if (exercises.empty()) throw Error({.what = "no points to draw", .found = "only faults of the grader"});
  const std::map<std::string, int> places = placesOf(exercises);
  Figure figure{.title = "Mean points of the parts (darker: fewer)",
                .xLabel = "part",
                .yLabel = "number of the exercise",
                .legend = Legend::kNone};
  std::size_t columns = 0;
  int first = places.begin()->second, last = first;
  for (const grading::ExerciseStatistics& one : all) {
    if (!exercises.contains(one.exercise)) continue;
    const int row = places.at(one.exercise);
    first = std::min(first, row), last = std::max(last, row);
    columns = std::max(columns, one.parts.size());
    for (std::size_t k = 0; k < one.parts.size(); ++k) {
      const grading::PartStatistics& part = one.parts[k];
      const double share = part.maxPoints > 0 ? part.meanPoints / part.maxPoints : 0;
      const auto column = static_cast<double>(k + 1);
      figure.regions.push_back(fieldOf(column, row, share));
      figure.notes.push_back(
          {.text = fmt::format("{} {:.0f} %", part.id, 100 * share), .x = column - 0.47, .y = double(row)});
    }
  }
  figure.width = static_cast<int>(std::min<std::size_t>(8192, 330 + 130 * columns));
  figure.height = std::min(8192, 170 + 40 * (last - first + 1));
  figure.xRange = AxisRange{0.5, static_cast<double>(columns) + 1.5};  // room for the last names
  figure.yRange = AxisRange{first - 0.5, last + 0.5};
  return figure;
}

}  // namespace rex::cli
