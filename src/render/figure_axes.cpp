#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace rex::internal
