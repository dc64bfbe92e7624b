#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "render/figure_check_internal.h"
#include "render/figure_view_internal.h"

namespace rex::internal {
namespace {

using Box = Eigen::AlignedBox2d;
using Eigen::Vector2d;

// Points as they lie on the paper, where a logarithmic axis is straight.
std::vector<Vector2d> pointsOf(const Trace& trace, const Figure& figure) {
  std::vector<Vector2d> points;
  for (const Eigen::Vector3d& p : trace.outline)
    points.emplace_back(figure.logX ? std::log10(p.x()) : p.x(), figure.logY ? std::log10(p.y()) : p.y());
  return points;
}

bool crosses(const Box& view, const Vector2d& from, const Vector2d& to) {
  if (!view.intersects(Box(from.cwiseMin(to), from.cwiseMax(to)))) return false;
  // The line through both points must not have all corners on one side.
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

// Even-odd rule: a ray to the right from inside crosses the border an odd number of times.
bool isInside(const std::vector<Vector2d>& outline, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    inside ^= p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return inside;
}

bool shows(const Box& view, const std::vector<Vector2d>& points, Extent extent) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (view.contains(points[i])) return true;
    if (extent == Extent::kPoints) continue;
    if (i > 0 && crosses(view, points[i - 1], points[i])) return true;
  }
  if (extent != Extent::kArea) return false;
  return crosses(view, points.back(), points.front()) || isInside(points, view.center());
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

void requireDataInView(const Figure& figure, const std::vector<Trace>& traces) {
  Box data;
  for (const Trace& trace : traces)
    for (const Vector2d& point : pointsOf(trace, figure)) data.extend(point);
  Box view = data;
  narrow(view, 0, figure.xRange, figure.logX);
  narrow(view, 1, figure.yRange, figure.logY);
  // A y axis without a range fits the points in the range of x, so there has to be one.
  const bool pointsOnly = figure.xRange && !figure.yRange;
  for (const Trace& trace : traces) {
    const Extent extent = pointsOnly && trace.extent == Extent::kLine ? Extent::kPoints : trace.extent;
    if (shows(view, pointsOf(trace, figure), extent)) return;
  }
  throw Error({.what = nameOf(figure),
               .found = "no data within " + describe(view, figure),
               .wanted = "ranges that meet the data: " + describe(data, figure)});
}

}  // namespace rex::internal
