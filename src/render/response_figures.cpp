#include "render/response_figures.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
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
