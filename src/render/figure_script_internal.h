#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/figure.h"

namespace rex::internal {

/// What the outline of a trace shows: its points, the line through them, or the inside.
enum class Extent { kPoints, kLine, kArea };

/// One layer as gnuplot draws it: rows of numbers, and the rest of the command. Colours are part of it.
struct Trace {
  std::string legend{};
  std::string drawing{};
  Eigen::MatrixXd rows{};
  Extent extent = Extent::kLine;
  std::vector<Eigen::Vector3d> outline{};
  bool wholeX = false, wholeY = false;  ///< tics belong on whole numbers
};

/// The layers of a drawable figure in the order of drawing, without guides and notes.
[[nodiscard]] std::vector<Trace> tracesOf(const Figure& figure);

/// Points of the ellipse, in order and without the first one at the end. The covariance is positive definite.
[[nodiscard]] Eigen::Matrix2Xd outlineOf(const CovarianceEllipse& ellipse);

/// "lc rgb '#RRGGBB'", or "lt N" with N = `otherwise`, which has colour N of the set.
[[nodiscard]] std::string colorOf(const std::optional<Color>& color, std::size_t otherwise);
/// "lc rgb '#RRGGBB'", or `otherwise`.
[[nodiscard]] std::string colorOf(const std::optional<Color>& color, const char* otherwise);

/// Where the values of a heat map or map lie: an expression for gnuplot's `using`, for columns and rows.
[[nodiscard]] std::string cellCentres(const AxisRange& xRange, const AxisRange& yRange,
                                      const Eigen::MatrixXd& cells);

/// The gnuplot commands that draw `figure` to standard output with `terminal`, "pngcairo" or "svg". Throws
/// Error as writeFigure() for a figure that cannot be drawn.
[[nodiscard]] std::string figureScript(const Figure& figure, const std::string& terminal);

}  // namespace rex::internal
