#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/color.h"

namespace rex {

enum class SeriesStyle { kLine, kPoints, kLinesPoints };

/// One curve of a figure: points (x[i], y[i]). With an empty x they are 0, 1, 2, ...
struct Series {
  std::string label{};  ///< in the legend; empty: not there
  std::vector<double> x{};
  std::vector<double> y{};
  SeriesStyle style = SeriesStyle::kLine;
  bool dashed = false;
  std::optional<Color> color{};  ///< otherwise the next of a set for any colour vision
};

/// Where the legend stands in the plot.
enum class Legend { kTopRight, kTopLeft, kBottomRight, kBottomLeft, kNone };

/// A plot of curves as plain data. Texts appear exactly as given, on one line; nothing in them is a command.
struct Figure {
  std::string title{};
  std::string xLabel{};  ///< with the unit: "time [s]"
  std::string yLabel{};
  bool logX = false;
  bool logY = false;
  bool equalAxes = false;  ///< one unit of x is as long as one of y
  std::optional<std::pair<double, double>> xRange{};
  std::optional<std::pair<double, double>> yRange{};
  Legend legend = Legend::kTopRight;
  std::vector<Series> series{};
  int width = 800;  ///< pixels, 100 to 8192
  int height = 500;
};

/// Draws the figure with gnuplot into a .png or .svg file, which appears whole or not at all. Throws Error
/// naming the figure and the series when there is nothing to draw, x and y differ in length, a number is not
/// finite, or not positive on a logarithmic axis, or the ranges show nothing of the data; naming the path
/// when it cannot be written or has another ending; naming the Debian package when gnuplot is missing.
void writeFigure(const Figure& figure, const std::filesystem::path& path);

/// The text of the .svg file of writeFigure(). Throws Error as that does.
[[nodiscard]] std::string encodeSvg(const Figure& figure);

}  // namespace rex
