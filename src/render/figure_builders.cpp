#include "render/figure_builders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

void requireCount(const char* what, int found, int low, int high) {
  if (found < low || found > high)
    throw Error(
        {.what = what, .found = fmt::format("{}", found), .wanted = fmt::format("{} to {}", low, high)});
}

Eigen::Map<const Eigen::VectorXd> numbersOf(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

// The middle of part `index` of `count` equal parts.
double centreOf(const AxisRange& range, int index, int count) {
  return range.first + (range.second - range.first) * (index + 0.5) / count;
}

Series signsOf(const std::vector<std::complex<double>>& values, const char* label, Marker marker) {
  Series series{.label = label, .style = SeriesStyle::kPoints, .marker = marker, .size = 2};
  for (const std::complex<double>& value : values) series.add(value.real(), value.imag());
  requireFinite(fmt::format("{}: real parts", label), numbersOf(series.x));
  requireFinite(fmt::format("{}: imaginary parts", label), numbersOf(series.y));
  return series;
}

Region unitDisc() {
  constexpr int kCorners = 180;
  Region disc{.label = "stable"};
  for (int i = 0; i < kCorners; ++i)
    disc.add(std::cos(2 * std::numbers::pi * i / kCorners), std::sin(2 * std::numbers::pi * i / kCorners));
  return disc;
}

}  // namespace

Histogram sampleHistogram(const std::vector<double>& samples, int bins) {
  requireCount("bins of a histogram", bins, 1, 10000);
  if (samples.empty()) throw Error({.what = "histogram", .found = "no samples", .wanted = "at least one"});
  requireFinite("samples of a histogram", numbersOf(samples));
  const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
  double low = *least, high = *greatest;
  if (low == high) low -= 0.5, high += 0.5;
  Histogram histogram;
  for (int i = 0; i <= bins; ++i) histogram.edges.push_back(i < bins ? low + (high - low) * i / bins : high);
  histogram.heights.resize(static_cast<std::size_t>(bins));
  for (const double sample : samples) {
    // A bin holds its lower edge.
    const auto edge = std::upper_bound(histogram.edges.begin() + 1, histogram.edges.end() - 1, sample);
    ++histogram.heights[static_cast<std::size_t>(edge - histogram.edges.begin() - 1)];
  }
  return histogram;
}

Histogram normalized(Histogram histogram) {
  double area = 0;
  for (std::size_t i = 0; i + 1 < histogram.edges.size() && i < histogram.heights.size(); ++i)
    area += histogram.heights[i] * (histogram.edges[i + 1] - histogram.edges[i]);
  if (!(area > 0))
    throw Error({.what = "normalized histogram",
                 .found = fmt::format("an area of {} between its edges", area),
                 .wanted = "more than 0"});
  for (double& height : histogram.heights) height /= area;
  return histogram;
}

HeatMap sampledHeatMap(const std::function<double(double, double)>& f, AxisRange xRange, AxisRange yRange,
                       int columns, int rows) {
  requireCount("columns of a heat map", columns, 2, 2000);
  requireCount("rows of a heat map", rows, 2, 2000);
  HeatMap heatMap{.xRange = xRange, .yRange = yRange, .values = Eigen::MatrixXd(rows, columns)};
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i)
      heatMap.values(i, j) = f(centreOf(xRange, j, columns), centreOf(yRange, i, rows));
  return heatMap;
}

Arrows arrowField(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& f, AxisRange xRange,
                  AxisRange yRange, int columns, int rows) {
  requireCount("columns of arrows", columns, 1, 200);
  requireCount("rows of arrows", rows, 1, 200);
  const Eigen::Vector2d cell((xRange.second - xRange.first) / columns, (yRange.second - yRange.first) / rows);
  Arrows arrows;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Eigen::Vector2d p(centreOf(xRange, j, columns), centreOf(yRange, i, rows));
      const Eigen::Vector2d inCells = f(p).cwiseQuotient(cell);
      if (inCells.isZero(0)) continue;
      const Eigen::Vector2d d = 0.7 * inCells.stableNormalized().cwiseProduct(cell);
      arrows.add(p - d / 2, d);
    }
  return arrows;
}

Figure poleFigure(const std::vector<std::complex<double>>& poles,
                  const std::vector<std::complex<double>>& zeros, TimeDomain domain) {
  if (poles.empty() && zeros.empty())
    throw Error({.what = "pole figure", .found = "no poles and no zeros", .wanted = "at least one"});
  const bool discrete = domain == TimeDomain::kDiscrete;
  Figure figure{.title = "Poles and zeros",
                .xLabel = discrete ? "real part [1]" : "real part [1/s]",
                .yLabel = discrete ? "imaginary part [1]" : "imaginary part [1/s]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .width = 640,
                .height = 500};
  if (!poles.empty()) figure.series.push_back(signsOf(poles, "poles", Marker::kCross));
  if (!zeros.empty()) figure.series.push_back(signsOf(zeros, "zeros", Marker::kCircle));
  double reach = discrete ? 1 : 0;  // half the side of a square around the origin that shows everything
  for (const Series& series : figure.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      reach = std::max({reach, std::abs(series.x[i]), std::abs(series.y[i])});
  reach = reach > 0 ? 1.2 * reach : 1;
  figure.xRange = figure.yRange = {-reach, reach};
  if (discrete)
    figure.regions = {unitDisc()};
  else
    figure.regions = {{.label = "stable", .x = {-reach, 0, 0, -reach}, .y = {-reach, -reach, reach, reach}}};
  figure.verticalLines = figure.horizontalLines = {{.at = 0}};
  return figure;
}

namespace {

void requireCounts(const char* what, std::size_t found, std::size_t wanted) {
  if (wanted == 0) throw Error({.what = what, .found = "no numbers", .wanted = "at least one"});
  requireSize(what, static_cast<long>(found), static_cast<long>(wanted));
}

Figure bodeFigure(const char* title, const char* yLabel, double guide, const std::vector<double>& frequencies,
                  const std::vector<double>& values) {
  requireCounts("values of a Bode plot", values.size(), frequencies.size());
  Figure figure{.title = title, .xLabel = "frequency [rad/s]", .yLabel = yLabel, .logX = true};
  figure.series = {{.x = frequencies, .y = values}};
  figure.horizontalLines = {{.at = guide}};
  return figure;
}

}  // namespace

Figure bodeMagnitudeFigure(const std::vector<double>& frequencies, const std::vector<double>& decibels) {
  return bodeFigure("Magnitude of the response", "magnitude [dB]", 0, frequencies, decibels);
}

Figure bodePhaseFigure(const std::vector<double>& frequencies, const std::vector<double>& degrees) {
  return bodeFigure("Phase of the response", "phase [degrees]", -180, frequencies, degrees);
}

Figure nyquistFigure(const std::vector<std::complex<double>>& values, double reach) {
  requireCounts("values of a Nyquist plot", values.size(), values.size());
  requirePositive("reach of a Nyquist plot", reach);
  Figure figure{.title = "Response in the complex plane",
                .xLabel = "real part [1]",
                .yLabel = "imaginary part [1]",
                .equalAxes = true,
                .xRange = AxisRange{-reach, reach},
                .yRange = AxisRange{-reach, reach},
                .legend = Legend::kOutside,
                .width = 700,
                .height = 500};
  Series ahead{.label = "w > 0"}, mirrored{.label = "w < 0"};
  mirrored.dashed = true;
  for (const std::complex<double>& value : values) {
    ahead.x.push_back(value.real()), ahead.y.push_back(value.imag());
    mirrored.x.push_back(value.real()), mirrored.y.push_back(-value.imag());
  }
  const Series critical{
      .label = "-1", .x = {-1}, .y = {0}, .style = SeriesStyle::kPoints, .marker = Marker::kCross, .size = 2};
  figure.series = {ahead, mirrored, critical};
  figure.verticalLines = figure.horizontalLines = {{.at = 0}};
  return figure;
}

Figure stepFigure(const std::vector<double>& times, const Eigen::MatrixXd& y,
                  const std::vector<std::string>& labels) {
  requireCounts("columns of a response over time", static_cast<std::size_t>(y.cols()), times.size());
  if (!labels.empty())
    requireCounts("labels of a response", labels.size(), static_cast<std::size_t>(y.rows()));
  Figure figure{.title = "Response to a step", .xLabel = "time [s]", .yLabel = "response"};
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    Series series{.label = labels.empty() ? fmt::format("y{}", i + 1) : labels[static_cast<std::size_t>(i)],
                  .x = times};
    for (const double value : y.row(i)) series.y.push_back(value);
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace rex
