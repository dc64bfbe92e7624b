#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "render/figure_axes_internal.h"
#include "render/figure_check_internal.h"

namespace rex::internal {
namespace {

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool whole = true;  // only whole numbers
  bool tight = false;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// The smallest of 1, 2, 5, 10, ... times a power of ten that divides `length` into at most `parts`.
double stepFor(double length, int parts) {
  const double least = length / parts;
  const int exponent = static_cast<int>(std::floor(std::log10(least)));
  for (const double digit : {1., 2., 5., 10.}) {
    // Dividing by a power of ten is exact, multiplying by 0.1 is not.
    const double step = exponent < 0 ? digit / std::pow(10., -exponent) : digit * std::pow(10., exponent);
    if (step >= least * (1 - 1e-9)) return step;
  }
  return 0;
}

// count * step; for 6 times 0.1 that is 0.6, where the product is a bit more.
double multiple(double count, double step) { return step < 1 ? count / std::round(1 / step) : count * step; }

Axis linearAxis(Span span, const std::optional<AxisRange>& range, int tics) {
  if (range) {
    span.low = range->first, span.high = range->second, span.tight = true;
  } else if (span.high - span.low <= std::max(1e-290, 1e-10 * std::max(-span.low, span.high))) {
    const double middle = span.low / 2 + span.high / 2;
    const bool byOne = std::abs(middle) < 1e-280 || (span.whole && std::abs(middle) < 1e6);
    const double margin = byOne ? 1 : std::abs(middle) / 10;
    span.low = middle - margin, span.high = middle + margin;
  }
  Axis axis{.low = span.low, .high = span.high, .step = stepFor(span.high - span.low, tics)};
  const bool holdsTwo = std::floor(span.high) - std::ceil(span.low) >= 1;
  if (span.whole && holdsTwo && axis.step < 1) axis.step = 1;
  if (span.tight) return axis;
  const double length = span.high - span.low;
  const double low = std::min(span.low, multiple(std::floor(span.low / axis.step + 1e-9), axis.step));
  const double high = std::max(span.high, multiple(std::ceil(span.high / axis.step - 1e-9), axis.step));
  axis.low = span.low - low <= 0.1 * length ? low : span.low - 0.03 * length;
  axis.high = high - span.high <= 0.1 * length ? high : span.high + 0.03 * length;
  return axis;
}

Axis logarithmicAxis(const Span& span, const std::optional<AxisRange>& range, int tics) {
  Axis axis{.low = span.low, .high = span.high};
  if (range) {
    axis.low = range->first, axis.high = range->second;
  } else if (!span.tight || span.low == span.high) {
    const double low = std::floor(std::log10(span.low) + 1e-9),
                 high = std::ceil(std::log10(span.high) - 1e-9);
    axis.low = std::pow(10, low), axis.high = std::pow(10, high > low ? high : low + 1);
  }
  const double decades = std::log10(axis.high) - std::log10(axis.low);
  if (decades >= 1) axis.step = std::pow(10, std::ceil(decades / tics - 1e-9));
  return axis;
}

Axis axisOf(const Span& span, const std::optional<AxisRange>& range, bool logarithmic, int tics) {
  return logarithmic ? logarithmicAxis(span, range, tics) : linearAxis(span, range, tics);
}

Span colorSpan(const Figure& figure) {
  Span span{.tight = true};
  const auto add = [&](double value) {
    span.add(value);
    span.whole &= value == std::floor(value);
  };
  for (const Series& series : figure.series) std::for_each(series.values.begin(), series.values.end(), add);
  if (figure.heatMap)
    for (const double value : figure.heatMap->values.reshaped()) add(value);
  return span;
}

bool contains(const std::optional<AxisRange>& range, double value) {
  return !range || (range->first <= value && value <= range->second);
}

}  // namespace

double shareOf(const Axis& axis, double value, bool logarithmic) {
  return logarithmic ? (std::log(value) - std::log(axis.low)) / (std::log(axis.high) - std::log(axis.low))
                     : (value / 2 - axis.low / 2) / (axis.high / 2 - axis.low / 2);
}

FigureAxes axesOf(const Figure& figure, const std::vector<Trace>& traces) {
  Span x, y, z;
  for (const Trace& trace : traces) {
    x.whole &= trace.wholeX;
    y.whole &= trace.wholeY;
    for (const Eigen::Vector3d& point : trace.outline) {
      x.add(point.x());
      // y spans the data within the range of x.
      if (trace.extent == Extent::kArea || contains(figure.xRange, point.x())) y.add(point.y());
      z.add(point.z());
    }
  }
  x.tight = y.tight = figure.heatMap || figure.map;
  z.whole = false;
  for (const Guide& guide : figure.verticalLines) x.add(guide.at);
  for (const Guide& guide : figure.horizontalLines) y.add(guide.at);
  for (const Note& note : figure.notes) {
    x.add(note.x);
    if (contains(figure.xRange, note.x)) y.add(note.y);
    z.add(note.z);
  }
  // Space for a tic with its label, in pixels.
  const int across = std::clamp(figure.width / 90, 3, 12), up = std::clamp(figure.height / 50, 3, 12);
  const int inDepth = std::max(2, across / 2);
  FigureAxes axes{.x = axisOf(x, figure.xRange, figure.logX, inSpace(figure) ? inDepth : across),
                  .y = axisOf(y, figure.yRange, figure.logY, inSpace(figure) ? inDepth : up),
                  .z = linearAxis(z, {}, std::max(2, up / 2))};
  if (hasColorBar(figure)) axes.color = axisOf(colorSpan(figure), figure.colorRange, figure.logColor, up);
  return axes;
}

namespace {

using Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

// The share of the plot that a legend in the top right corner takes up, estimated with letters of the usual
// width.
Vector2d sizeOf(const Figure& figure, const std::vector<Trace>& traces) {
  std::size_t longest = 0, lines = 0;
  for (const Trace& trace : traces) {
    longest = std::max(longest, trace.legend.size());
    lines += trace.legend.empty() ? 0 : 1;
  }
  const double width = 60 + 7.5 * static_cast<double>(longest), height = 15 + 18 * static_cast<double>(lines);
  return {std::min(0.5, width / (figure.width - 90)), std::min(0.5, height / (figure.height - 90))};
}

// Points of the trace as shares of the plot, spaced closely along its lines, too.
template <typename Visit>
void visitSamples(const Figure& figure, const Trace& trace, const FigureAxes& axes, const Visit& visit) {
  std::optional<Vector2d> last;
  for (const Eigen::Vector3d& point : trace.outline) {
    const Vector2d p(shareOf(axes.x, point.x(), figure.logX), shareOf(axes.y, point.y(), figure.logY));
    const double length = last && trace.extent != Extent::kPoints ? (p - *last).norm() : 0;
    const int parts = 1 + static_cast<int>(std::min(500., 50 * length));
    for (int k = parts - 1; k >= 0; --k) visit(last ? Vector2d(p + (*last - p) * k / parts) : p);
    last = p;
  }
}

}  // namespace

Legend emptiestCorner(const Figure& figure, const std::vector<Trace>& traces, const FigureAxes& axes) {
  struct Place {
    Legend legend;
    Box box;
    double hidden = 0;
  };
  const Vector2d size = sizeOf(figure, traces);
  const double left = 1 - size.x(), low = 1 - size.y();
  std::array<Place, 4> places = {{{Legend::kTopRight, {Vector2d(left, low), Vector2d(1, 1)}},
                                  {Legend::kTopLeft, {Vector2d(0, low), Vector2d(size.x(), 1)}},
                                  {Legend::kBottomRight, {Vector2d(left, 0), Vector2d(1, size.y())}},
                                  {Legend::kBottomLeft, {Vector2d(0, 0), size}}}};
  for (const Trace& trace : traces)
    visitSamples(figure, trace, axes, [&](const Vector2d& p) {
      for (Place& place : places) place.hidden += place.box.contains(p) ? 1 : 0;
    });
  const auto hidesLess = [](const Place& a, const Place& b) { return a.hidden < b.hidden; };
  return std::min_element(places.begin(), places.end(), hidesLess)->legend;
}

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
