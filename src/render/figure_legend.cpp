#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "render/figure_legend_internal.h"

namespace rex::internal {
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

}  // namespace rex::internal
