#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "render/figure_check_internal.h"
#include "render/text_internal.h"

namespace rex::internal {
namespace {

using Values = std::vector<double>;

// gnuplot treats larger numbers as missing.
bool isNumber(double value) { return std::abs(value) <= 1e300; }

bool isBlank(const std::string& text) { return singleLine(text).find_first_not_of(' ') == std::string::npos; }

// "figure 'F', band 2" or "figure 'F', band 'error'".
std::string layerName(const Figure& figure, const char* kind, std::size_t index, const std::string& label) {
  return label.empty() ? fmt::format("{}, {} {}", nameOf(figure), kind, index)
                       : fmt::format("{}, {} '{}'", nameOf(figure), kind, singleLine(label));
}

void requireNumber(double value, bool logarithmic, const std::string& name, const std::string& field) {
  // The next decade below 1e-300 may be too small for a double.
  if (isNumber(value) && (!logarithmic || value >= 1e-300)) return;
  throw Error({.what = name,
               .found = fmt::format("{} = {}", field, value),
               .wanted = logarithmic ? "finite numbers above 0, for the logarithmic axis"
                                     : "finite numbers, up to 1e300"});
}

void requireNumbers(const Values& values, bool logarithmic, const std::string& name, const char* field) {
  for (std::size_t i = 0; i < values.size(); ++i)
    requireNumber(values[i], logarithmic, name, fmt::format("{}[{}]", field, i));
}

void requireAsMany(const std::string& name, const char* field, const Values& values, const char* other,
                   const Values& others) {
  if (values.size() != others.size())
    throw Error({.what = name,
                 .found = fmt::format("{} {} and {} {}", values.size(), field, others.size(), other),
                 .wanted = fmt::format("as many {} as {}", field, other)});
}

void requireSome(const std::string& name, std::size_t count) {
  if (count == 0) throw Error({.what = name, .found = "no points", .wanted = "at least one"});
}

void requireRange(const AxisRange& range, bool logarithmic, const std::string& name) {
  const auto [low, high] = range;
  // One part in 10^10 leaves enough digits for tics.
  const bool apart = high - low > 1e-10 * std::max(std::abs(low), std::abs(high));
  if (isNumber(low) && isNumber(high) && apart && (!logarithmic || low >= 1e-300)) return;
  throw Error({.what = name,
               .found = fmt::format("{} to {}", low, high),
               .wanted = logarithmic ? "0 < low < high" : "low < high"});
}

void requireLinear(const Figure& figure, const std::string& name) {
  if (figure.logX || figure.logY)
    throw Error({.what = name, .found = "a logarithmic axis", .wanted = "linear axes for this layer"});
}

void requireLabel(const std::string& label, const char* field, const std::string& name) {
  if (isBlank(label))
    throw Error({.what = name,
                 .found = fmt::format("no {}", field),
                 .wanted = "one, with the unit, such as \"distance [m]\" or \"step\""});
}

// The x of a series or band, which may be left out.
void requirePositions(const Figure& figure, const std::string& name, const Values& x, const Values& y,
                      const char* yName) {
  requireSome(name, y.size());
  if (!x.empty()) requireAsMany(name, "x", x, yName, y);
  if (x.empty() && figure.logX)
    throw Error({.what = name, .found = "no x", .wanted = "x for the logarithmic axis"});
  requireNumbers(x, figure.logX, name, "x");
  requireNumbers(y, figure.logY, name, yName);
}

void requireLayer(const Figure& figure, const Series& series, const std::string& name) {
  requirePositions(figure, name, series.x, series.y, "y");
  if (inSpace(figure)) requireAsMany(name, "z", series.z, "y", series.y);
  requireNumbers(series.z, false, name, "z");
  if (!series.values.empty()) requireAsMany(name, "values", series.values, "y", series.y);
  requireNumbers(series.values, figure.logColor, name, "values");
  if (!(series.size > 0 && series.size <= 20))
    throw Error({.what = name, .found = fmt::format("size = {}", series.size), .wanted = "0 < size <= 20"});
}

void requireLayer(const Figure& figure, const Band& band, const std::string& name) {
  requirePositions(figure, name, band.x, band.low, "low");
  if (band.low.size() == 1) throw Error({.what = name, .found = "one point", .wanted = "at least two"});
  requireAsMany(name, "high", band.high, "low", band.low);
  requireNumbers(band.high, figure.logY, name, "high");
  for (std::size_t i = 0; i < band.low.size(); ++i)
    if (band.low[i] > band.high[i])
      throw Error({.what = name,
                   .found = fmt::format("low[{0}] = {1}, high[{0}] = {2}", i, band.low[i], band.high[i]),
                   .wanted = "low <= high"});
}

void requireLayer(const Figure& figure, const Histogram& histogram, const std::string& name) {
  const Values& edges = histogram.edges;
  requireLinear(figure, name);
  requireSome(name, histogram.heights.size());
  if (!edges.empty() && edges.size() != histogram.heights.size() + 1)
    throw Error({.what = name,
                 .found = fmt::format("{} edges and {} heights", edges.size(), histogram.heights.size()),
                 .wanted = "one more edge than heights, or no edges"});
  requireNumbers(edges, false, name, "edges");
  requireNumbers(histogram.heights, false, name, "heights");
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i] <= edges[i - 1])
      throw Error({.what = name,
                   .found = fmt::format("edges[{}] = {} after {}", i, edges[i], edges[i - 1]),
                   .wanted = "ascending edges"});
}

void requireLayer(const Figure& figure, const CovarianceEllipse& ellipse, const std::string& name) {
  requireLinear(figure, name);
  for (int i = 0; i < 2; ++i) requireNumber(ellipse.mean[i], false, name, fmt::format("mean[{}]", i));
  if (!(ellipse.sigmas > 0 && ellipse.sigmas <= 100))
    throw Error(
        {.what = name, .found = fmt::format("sigmas = {}", ellipse.sigmas), .wanted = "0 < sigmas <= 100"});
  const Eigen::Matrix2d& P = ellipse.covariance;
  // Rounding errors of a filter do not count as asymmetry; the drawing uses the lower triangle.
  const bool symmetric = std::abs(P(0, 1) - P(1, 0)) <= 1e-6 * P.cwiseAbs().maxCoeff();
  const bool finite = isNumber(P.cwiseAbs().maxCoeff()) && P.allFinite();
  if (!finite || !symmetric || P.llt().info() != Eigen::Success)
    throw Error({.what = name,
                 .found = fmt::format("the covariance [{} {}; {} {}]", P(0, 0), P(0, 1), P(1, 0), P(1, 1)),
                 .wanted = "a symmetric and positive definite one"});
}

void requireLayer(const Figure& figure, const Region& region, const std::string& name) {
  requireAsMany(name, "x", region.x, "y", region.y);
  if (region.x.size() < 3)
    throw Error({.what = name, .found = fmt::format("{} corners", region.x.size()), .wanted = "at least 3"});
  requireNumbers(region.x, figure.logX, name, "x");
  requireNumbers(region.y, figure.logY, name, "y");
}

void requireLayer(const Figure& figure, const Arrows& arrows, const std::string& name) {
  requireLinear(figure, name);
  requireSome(name, arrows.x.size());
  const Values& x = arrows.x;
  requireNumbers(x, false, name, "x");
  for (const auto& [field, values] :
       {std::pair{"y", &arrows.y}, std::pair{"dx", &arrows.dx}, std::pair{"dy", &arrows.dy}}) {
    requireAsMany(name, field, *values, "x", x);
    requireNumbers(*values, false, name, field);
  }
}

void requireLayer(const Figure& figure, const Guide& guide, bool vertical, const std::string& name) {
  requireNumber(guide.at, vertical ? figure.logX : figure.logY, name, "at");
}

void requireLayer(const Figure& figure, const Note& note, const std::string& name) {
  requireNumber(note.x, figure.logX, name, "x");
  requireNumber(note.y, figure.logY, name, "y");
  requireNumber(note.z, false, name, "z");
}

void requireCells(const Figure& figure, const Eigen::MatrixXd& cells, const AxisRange& xRange,
                  const AxisRange& yRange, const std::string& name) {
  requireLinear(figure, name);
  requireRange(xRange, false, name + ", xRange");
  requireRange(yRange, false, name + ", yRange");
  if (cells.rows() < 2 || cells.cols() < 2)
    throw Error({.what = name,
                 .found = fmt::format("{} x {} cells", cells.rows(), cells.cols()),
                 .wanted = "at least 2 x 2"});
}

void requireHeatMap(const Figure& figure) {
  const std::string name = nameOf(figure) + ", heat map";
  const HeatMap& heatMap = *figure.heatMap;
  requireCells(figure, heatMap.values, heatMap.xRange, heatMap.yRange, name);
  if (heatMap.contours < 0 || heatMap.contours > 100)
    throw Error({.what = name, .found = fmt::format("{} contours", heatMap.contours), .wanted = "0 to 100"});
  for (Eigen::Index j = 0; j < heatMap.values.cols(); ++j)
    for (Eigen::Index i = 0; i < heatMap.values.rows(); ++i)
      requireNumber(heatMap.values(i, j), figure.logColor, name, fmt::format("values({}, {})", i, j));
}

void requireMap(const Figure& figure) {
  const std::string name = nameOf(figure) + ", map";
  const OccupancyCells& map = *figure.map;
  requireCells(figure, map.occupancy, map.xRange, map.yRange, name);
  for (Eigen::Index j = 0; j < map.occupancy.cols(); ++j)
    for (Eigen::Index i = 0; i < map.occupancy.rows(); ++i)
      if (!(map.occupancy(i, j) >= 0 && map.occupancy(i, j) <= 1))
        throw Error({.what = name,
                     .found = fmt::format("occupancy({}, {}) = {}", i, j, map.occupancy(i, j)),
                     .wanted = "0 (free) to 1 (occupied)"});
}

bool hasFlatLayers(const Figure& figure) {
  return !figure.verticalLines.empty() || !figure.horizontalLines.empty() || !figure.ellipses.empty() ||
         !figure.arrows.empty() || !figure.histograms.empty() || !figure.bands.empty() ||
         !figure.regions.empty() || figure.heatMap || figure.map;
}

bool hasData(const Figure& figure) {
  return !figure.series.empty() || !figure.ellipses.empty() || !figure.arrows.empty() ||
         !figure.histograms.empty() || !figure.bands.empty() || !figure.regions.empty() || figure.heatMap ||
         figure.map;
}

void requireFrame(const Figure& figure) {
  const std::string name = nameOf(figure);
  if (!hasData(figure))
    throw Error({.what = name, .found = "nothing to draw", .wanted = "at least one series or other layer"});
  const auto inRange = [](int size) { return size >= 100 && size <= 8192; };
  if (!inRange(figure.width) || !inRange(figure.height))
    throw Error({.what = name,
                 .found = fmt::format("a size of {} x {}", figure.width, figure.height),
                 .wanted = "100 to 8192 pixels each way"});
  requireLabel(figure.xLabel, "xLabel", name);
  requireLabel(figure.yLabel, "yLabel", name);
  if (inSpace(figure)) requireLabel(figure.zLabel, "zLabel", name);
  if (hasColorBar(figure)) requireLabel(figure.colorLabel, "colorLabel", name);
  if (figure.xRange) requireRange(*figure.xRange, figure.logX, name + ", range of x");
  if (figure.yRange) requireRange(*figure.yRange, figure.logY, name + ", range of y");
  if (figure.colorRange) requireRange(*figure.colorRange, figure.logColor, name + ", range of colours");
  if (inSpace(figure) && hasFlatLayers(figure))
    throw Error({.what = name,
                 .found = "series with z and a layer without",
                 .wanted = "only series and notes in a figure in space"});
}

}  // namespace

std::string nameOf(const Figure& figure) { return fmt::format("figure '{}'", singleLine(figure.title)); }

bool inSpace(const Figure& figure) {
  return std::any_of(figure.series.begin(), figure.series.end(),
                     [](const Series& series) { return !series.z.empty(); });
}

bool hasColorBar(const Figure& figure) {
  return figure.heatMap || std::any_of(figure.series.begin(), figure.series.end(),
                                       [](const Series& series) { return !series.values.empty(); });
}

void requireDrawable(const Figure& figure) {
  requireFrame(figure);
  const auto requireLayers = [&](const char* kind, const auto& layers) {
    for (std::size_t k = 0; k < layers.size(); ++k)
      requireLayer(figure, layers[k], layerName(figure, kind, k, layers[k].label));
  };
  requireLayers("series", figure.series);
  requireLayers("band", figure.bands);
  requireLayers("histogram", figure.histograms);
  requireLayers("ellipse", figure.ellipses);
  requireLayers("region", figure.regions);
  requireLayers("arrows", figure.arrows);
  for (const bool vertical : {true, false}) {
    const std::vector<Guide>& guides = vertical ? figure.verticalLines : figure.horizontalLines;
    const char* kind = vertical ? "vertical line" : "horizontal line";
    for (std::size_t k = 0; k < guides.size(); ++k)
      requireLayer(figure, guides[k], vertical, layerName(figure, kind, k, guides[k].label));
  }
  for (std::size_t k = 0; k < figure.notes.size(); ++k)
    requireLayer(figure, figure.notes[k], layerName(figure, "note", k, figure.notes[k].text));
  if (figure.heatMap) requireHeatMap(figure);
  if (figure.map) requireMap(figure);
}

}  // namespace rex::internal
