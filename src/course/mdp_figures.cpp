#include "course/mdp_figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr double kArrow = .38;  // of a cell

Figure emptyGrid(const GridWorld& world, const Eigen::VectorXd& values) {
  requireSize("values of the grid", values.size(), static_cast<long>(world.cells.size()));
  requireFinite("values of the grid", values);
  if (world.width < 2 || world.height < 2)
    throw Error({.what = "grid to draw",
                 .found = fmt::format("{} x {} cells", world.width, world.height),
                 .wanted = "2 x 2 or more"});
  Figure figure;
  figure.xLabel = "column";
  figure.yLabel = "row";
  figure.colorLabel = "value";
  figure.equalAxes = true;
  figure.legend = Legend::kNone;
  const AxisRange x{-.5, world.width - .5}, y{-.5, world.height - .5};
  figure.xRange = x;
  figure.yRange = y;
  // A wall has the colour of the low end, which lies well below all values: on those, numbers can be read.
  const double low = values.minCoeff(), high = values.maxCoeff();
  figure.colorRange = AxisRange{low - (low < high ? .5 * (high - low) : .5), low < high ? high : high + .5};
  HeatMap map{x, y, Eigen::MatrixXd::Constant(world.height, world.width, figure.colorRange->first)};
  for (std::size_t s = 0; s < world.cells.size(); ++s)
    map.values(world.cells[s][1], world.cells[s][0]) = values[static_cast<Eigen::Index>(s)];
  figure.heatMap = map;
  for (int row = 0; row < world.height; ++row)
    for (int column = 0; column < world.width; ++column)
      if (!world.state(column, row))
        figure.regions.push_back({.x = {column - .5, column + .5, column + .5, column - .5},
                                  .y = {row - .5, row - .5, row + .5, row + .5},
                                  .color = Color{.2F, .2F, .22F}});
  return figure;
}

void requireEqualRuns(const LearningCurves& curve) {
  if (curve.runs.empty())
    throw Error({.what = fmt::format("learning curves '{}'", curve.label), .found = "no run"});
  for (std::size_t i = 0; i < curve.runs.size(); ++i) {
    const std::string name = fmt::format("run {} of '{}'", i, curve.label);
    const auto size = static_cast<Eigen::Index>(curve.runs[i].size());
    requireSize(name, size, static_cast<Eigen::Index>(curve.runs.front().size()));
    requireFinite(name, Eigen::Map<const Eigen::VectorXd>(curve.runs[i].data(), size));
  }
}

double percentile(std::vector<double> numbers, double share) {
  std::sort(numbers.begin(), numbers.end());
  const double place = share * static_cast<double>(numbers.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, numbers.size() - 1);
  return std::lerp(numbers[below], numbers[above], place - std::floor(place));
}

}  // namespace

Figure valueFigure(const GridWorld& world, const Eigen::VectorXd& values) {
  Figure figure = emptyGrid(world, values);
  for (std::size_t s = 0; s < world.cells.size(); ++s) {
    const auto& [column, row] = world.cells[s];
    // Next to the right border, a note ends where it would otherwise begin.
    const bool endsThere = (column + .5) / world.width > .8;
    figure.notes.push_back({.text = fmt::format("{:.2f}", values[static_cast<Eigen::Index>(s)]),
                            .x = column + (endsThere ? .3 : -.3),
                            .y = row - .1});
  }
  return figure;
}

Figure policyFigure(const GridWorld& world, const Eigen::VectorXd& values, const Eigen::MatrixXd& policy) {
  Figure figure = emptyGrid(world, values);
  if (policy.rows() != values.size() || policy.cols() != 4)
    throw Error({.what = "policy of the grid",
                 .found = fmt::format("{} x {}", policy.rows(), policy.cols()),
                 .wanted = fmt::format("{} x 4", values.size())});
  Arrows arrows{.color = Color{0, 0, 0}};
  for (std::size_t s = 0; s < world.cells.size(); ++s) {
    if (world.mdp.isTerminal(static_cast<int>(s))) continue;
    for (int a = 0; a < 4; ++a) {
      const double length = kArrow * policy(static_cast<Eigen::Index>(s), a);
      if (length < .02) continue;
      const Eigen::Vector2d ways[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
      arrows.add({1. * world.cells[s][0], 1. * world.cells[s][1]}, length * ways[a]);
    }
  }
  if (!arrows.x.empty()) figure.arrows.push_back(arrows);
  return figure;
}

Figure learningFigure(const std::vector<LearningCurves>& curves) {
  Figure figure;
  figure.xLabel = "iteration";
  figure.yLabel = "return";
  for (const LearningCurves& curve : curves) {
    requireEqualRuns(curve);
    Series mean{.label = curve.label};
    Band band;
    for (std::size_t i = 0; i < curve.runs.front().size(); ++i) {
      std::vector<double> now;
      for (const std::vector<double>& run : curve.runs) now.push_back(run[i]);
      double sum = 0;
      for (const double value : now) sum += value;
      mean.add(static_cast<double>(i), sum / static_cast<double>(now.size()));
      band.low.push_back(percentile(now, .1));
      band.high.push_back(percentile(now, .9));
    }
    band.x = mean.x;
    figure.series.push_back(std::move(mean));
    figure.bands.push_back(std::move(band));
  }
  return figure;
}

}  // namespace rex
