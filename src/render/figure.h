#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "render/color.h"

namespace rex {

/// The lower and upper end of an axis or of a part of it.
using AxisRange = std::pair<double, double>;

enum class SeriesStyle { kLine, kPoints, kLinesPoints };

/// The symbol at a point. kAuto uses a different one for each series.
enum class Marker { kAuto, kDot, kCircle, kCross, kPlus, kSquare, kTriangle };

/// One curve or cloud of points (x[i], y[i]). An empty x stands for 0, 1, 2, ... In a 3-D figure every
/// series has a z. With `values`, one for each point, the colour bar colours the points.
struct Series {
  std::string label{};  ///< in the legend; empty: not shown
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<double> z{};
  std::vector<double> values{};
  SeriesStyle style = SeriesStyle::kLine;
  Marker marker = Marker::kAuto;
  double size = 1;  ///< factor for the width of lines and the size of points; up to 20
  bool dashed = false;
  std::optional<Color> color{};  ///< default: the next of a set suitable for any colour vision

  void add(double atX, double atY) {
    x.push_back(atX);
    y.push_back(atY);
  }
};

/// The strip from low[i] to high[i] at x[i], such as an error around a mean, with x as for a series. By
/// default band k has the colour of series k.
struct Band {
  std::string label{};
  std::vector<double> x{};
  std::vector<double> low{};
  std::vector<double> high{};
  std::optional<Color> color{};
};

/// Bars from 0 to heights[i] between edges[i] and edges[i + 1], which ascend. Without edges the bars stand at
/// 0, 1, 2, ... sampleHistogram() in render/figure_builders.h counts samples.
struct Histogram {
  std::string label{};
  std::vector<double> edges{};
  std::vector<double> heights{};
  std::optional<Color> color{};
};

/// All points at `sigmas` standard deviations from the mean of a normal distribution. The covariance must
/// be symmetric and positive definite.
struct CovarianceEllipse {
  std::string label{};
  Eigen::Vector2d mean{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double sigmas = 2;
  std::optional<Color> color{};  ///< default: the second of the set
};

/// The inside of the polygon (x[i], y[i]), shaded.
struct Region {
  std::string label{};
  std::vector<double> x{};
  std::vector<double> y{};
  std::optional<Color> color{};  ///< otherwise grey

  void add(double atX, double atY) {
    x.push_back(atX);
    y.push_back(atY);
  }
};

/// Arrows from (x[i], y[i]) to (x[i] + dx[i], y[i] + dy[i]). arrowField() in render/figure_builders.h draws a
/// vector field.
struct Arrows {
  std::string label{};
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<double> dx{};
  std::vector<double> dy{};
  std::optional<Color> color{};  ///< otherwise grey

  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& along) {
    x.push_back(from.x());
    y.push_back(from.y());
    dx.push_back(along.x());
    dy.push_back(along.y());
  }
};

/// Values as colours: a rectangle of equal cells, row 0 at the low end of y, column 0 at the low end of x.
/// sampledHeatMap() in render/figure_builders.h samples a function.
struct HeatMap {
  AxisRange xRange{0, 1};    ///< outer edges of the first and the last column
  AxisRange yRange{0, 1};    ///< of the rows
  Eigen::MatrixXd values{};  ///< rows x columns, at least 2 x 2
  int contours = 0;          ///< number of contour lines, at equal steps of colour; up to 100
};

/// A grid map seen from above, in grey: 0 is free and white, 1 occupied and black, 0.5 unknown. Cells are
/// as in a heat map, with sizes usually in metres.
struct OccupancyCells {
  AxisRange xRange{0, 1};
  AxisRange yRange{0, 1};
  Eigen::MatrixXd occupancy{};  ///< rows x columns, at least 2 x 2, each in [0, 1]
};

/// A straight line across the whole figure, vertical at x = at or horizontal at y = at.
struct Guide {
  double at = 0;
  std::string label{};
  std::optional<Color> color{};  ///< default: dark grey
};

/// Text beside the point (x, y), or (x, y, z) in a 3-D figure.
struct Note {
  std::string text{};
  double x = 0;
  double y = 0;
  double z = 0;
};

/// The position of the legend: in a corner of the plot (kAuto: the emptiest, in 3-D the top right), or
/// beside it, where it hides nothing.
enum class Legend { kAuto, kTopRight, kTopLeft, kBottomRight, kBottomLeft, kOutside, kNone };

/// A plot as plain data: any layers of render/figure.h over the same two axes, or series in 3-D over
/// three. Texts appear exactly as given, on one line; nothing in them is a command. Axes must have labels,
/// which should give the unit: "time [s]", "cost [1]".
struct Figure {
  std::string title{};
  std::string xLabel{};
  std::string yLabel{};
  std::vector<std::string> yNames{};  ///< beside 0, 1, 2, ... on the y axis, instead of numbers
  std::string zLabel{};               ///< needed if series have z
  std::string colorLabel{};           ///< beside the colour bar; needed with a heat map or values of points
  bool logX = false;
  bool logY = false;
  bool logColor = false;
  bool equalAxes = false;  ///< one unit has the same length on all axes
  std::optional<AxisRange> xRange{};
  std::optional<AxisRange> yRange{};
  std::optional<AxisRange> colorRange{};
  Legend legend = Legend::kAuto;
  std::vector<Series> series{};
  // Drawn before the series, the last of these first; notes come on top.
  std::vector<Guide> verticalLines{};
  std::vector<Guide> horizontalLines{};
  std::vector<CovarianceEllipse> ellipses{};
  std::vector<Arrows> arrows{};
  std::vector<Histogram> histograms{};
  std::vector<Band> bands{};
  std::vector<Region> regions{};
  std::optional<HeatMap> heatMap{};
  std::optional<OccupancyCells> map{};
  std::vector<Note> notes{};
  int width = 800;  ///< pixels, 100 to 8192
  int height = 500;
};

/// The figure with x and y in metres, in one scale.
[[nodiscard]] Figure planeFigure(Figure figure);

namespace internal {

// Throws Error unless a point has two numbers or more.
void requirePlanePoint(Eigen::Index numbers);

// Adds the first two entries of each element of a list, or of each column of a matrix.
template <class Layer, class Points>
[[nodiscard]] Layer withPoints(Layer layer, const Points& points) {
  const auto add = [&](const auto& point) {
    if constexpr (requires { point.size(); }) requirePlanePoint(static_cast<Eigen::Index>(point.size()));
    layer.add(point[0], point[1]);
  };
  if constexpr (requires { points.colwise(); })
    for (const auto& point : points.colwise()) add(point);
  else
    for (const auto& point : points) add(point);
  return layer;
}

}  // namespace internal

/// A curve through points in the plane, or through the positions of poses (x, y, heading): the columns of a
/// matrix, a list of vectors, or one vector. `curve` says how it looks, and may have points already. Throws
/// Error for points with fewer than two numbers, as the next two do.
template <class Points>
[[nodiscard]] Series through(const Points& points, Series curve = {}) {
  return internal::withPoints(std::move(curve), points);
}
[[nodiscard]] inline Series through(std::initializer_list<Eigen::Vector2d> points, Series curve = {}) {
  return internal::withPoints(std::move(curve), points);
}

/// The same as points without a line, dots unless `look` has another marker.
template <class Points>
[[nodiscard]] Series dots(const Points& points, Series look = {}) {
  look.style = SeriesStyle::kPoints;
  if (look.marker == Marker::kAuto) look.marker = Marker::kDot;
  return through(points, std::move(look));
}

/// The inside of the polygon with these corners.
template <class Points>
[[nodiscard]] Region within(const Points& corners, Region look = {}) {
  return internal::withPoints(std::move(look), corners);
}

/// Values at 0, step, 2 step, ... seconds: a list, or a row or column of a matrix.
template <class Values>
[[nodiscard]] Series overTime(const Values& values, double step, Series curve = {}) {
  for (const double value : values) curve.add(step * static_cast<double>(curve.y.size()), value);
  return curve;
}

/// Draws the figure with gnuplot into a .png or .svg file, which appears whole or not at all. Throws Error
/// naming the figure and the layer if an axis has no label, there is nothing to draw, sizes differ, a
/// number is not finite, or not positive on a logarithmic axis, a layer does not fit its axes, or the
/// ranges show none of the data; naming the path if it cannot be written or has another extension; naming
/// the Debian package if gnuplot is missing.
void writeFigure(const Figure& figure, const std::string& path);

/// The text of the .svg file of writeFigure(). Throws Error as that does.
[[nodiscard]] std::string encodeSvg(const Figure& figure);

}  // namespace rex
