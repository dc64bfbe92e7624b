#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "render/figure_view_internal.h"

namespace rex::internal {
namespace {

using Box = Eigen::AlignedBox2d;
using Eigen::Vector2d;

// Points as they lie on the paper, where a logarithmic axis is straight.
std::vector<Vector2d> pointsOf(const Series& series, const Figure& figure) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    const double x = series.x.empty() ? static_cast<double>(i) : series.x[i], y = series.y[i];
    points.emplace_back(figure.logX ? std::log10(x) : x, figure.logY ? std::log10(y) : y);
  }
  return points;
}

bool crosses(const Box& view, const Vector2d& from, const Vector2d& to) {
  if (!view.intersects(Box(from.cwiseMin(to), from.cwiseMax(to)))) return false;
  // The line through both points must not leave all corners on one side.
  const Vector2d along = (to / 2 - from / 2).stableNormalized();
  bool left = false, right = false;
  for (int k = 0; k < 4; ++k) {
    const Vector2d corner = view.corner(static_cast<Box::CornerType>(k)) - from;
    const double side = along.x() * corner.y() - along.y() * corner.x();
    left |= side >= 0;
    right |= side <= 0;
  }
  return left && right;
}

bool shows(const Box& view, const std::vector<Vector2d>& points, bool linesCount) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (view.contains(points[i])) return true;
    if (linesCount && i > 0 && crosses(view, points[i - 1], points[i])) return true;
  }
  return false;
}

// A range that is not given spans the data.
void narrow(Box& view, int axis, const std::optional<std::pair<double, double>>& range, bool logarithmic) {
  if (!range) return;
  view.min()[axis] = logarithmic ? std::log10(range->first) : range->first;
  view.max()[axis] = logarithmic ? std::log10(range->second) : range->second;
}

std::string describe(const char* axis, double low, double high, bool logarithmic) {
  return fmt::format("{} {:.6g} to {:.6g}", axis, logarithmic ? std::pow(10, low) : low,
                     logarithmic ? std::pow(10, high) : high);
}

std::string describe(const Box& box, const Figure& figure) {
  return describe("x", box.min().x(), box.max().x(), figure.logX) + ", " +
         describe("y", box.min().y(), box.max().y(), figure.logY);
}

}  // namespace

void requireDataInView(const Figure& figure, const std::string& name) {
  Box data;
  for (const Series& series : figure.series)
    for (const Vector2d& point : pointsOf(series, figure)) data.extend(point);
  Box view = data;
  narrow(view, 0, figure.xRange, figure.logX);
  narrow(view, 1, figure.yRange, figure.logY);
  // gnuplot fits a y axis without a range to the points in the range of x, and fails if there is none.
  const bool pointsOnly = figure.xRange && !figure.yRange;
  for (const Series& series : figure.series) {
    const bool linesCount = series.style != SeriesStyle::kPoints && !pointsOnly;
    if (shows(view, pointsOf(series, figure), linesCount)) return;
  }
  throw Error({.what = name,
               .found = "no data within " + describe(view, figure),
               .wanted = "ranges that meet the data: " + describe(data, figure)});
}

}  // namespace rex::internal
