#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/figure_layers.h"

namespace rex {

/// The position of the legend: in a corner of the plot (kAuto: the emptiest, in 3-D the top right), or
/// beside it, where it hides nothing.
enum class Legend { kAuto, kTopRight, kTopLeft, kBottomRight, kBottomLeft, kOutside, kNone };

/// A plot as plain data: any layers of render/figure_layers.h over the same two axes, or series in 3-D over
/// three. Texts appear exactly as given, on one line; nothing in them is a command. Axes must have labels,
/// which should give the unit: "time [s]", "cost [1]".
struct Figure {
  std::string title{};
  std::string xLabel{};
  std::string yLabel{};
  std::string zLabel{};      ///< needed if series have z
  std::string colorLabel{};  ///< beside the colour bar; needed with a heat map or values of points
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

/// Draws the figure with gnuplot into a .png or .svg file, which appears whole or not at all. Throws Error
/// naming the figure and the layer if an axis has no label, there is nothing to draw, sizes differ, a
/// number is not finite, or not positive on a logarithmic axis, a layer does not fit its axes, or the
/// ranges show none of the data; naming the path if it cannot be written or has another extension; naming
/// the Debian package if gnuplot is missing.
void writeFigure(const Figure& figure, const std::string& path);

/// The text of the .svg file of writeFigure(). Throws Error as that does.
[[nodiscard]] std::string encodeSvg(const Figure& figure);

}  // namespace rex
